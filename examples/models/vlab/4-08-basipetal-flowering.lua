--!strict
-- Basipetal flowering by two signals: florigen climbs to the apex, and the flower sends a second signal down, which
-- wakes the lateral buds from the top to the base.
-- Source: Virtual Laboratory (cpfg), Signaling/08-basipetal-2-signals, University of Calgary.
local steps = param("steps", { default = 50, min = 0, max = 70, step = 1, doc = "Steps of growth" })
local delay =
  param("delay", { default = 15, min = 1, max = 30, step = 1, unit = "steps", doc = "Delay of florigen" })
local total = param("total", { default = 3, min = 0, max = 8, step = 1, doc = "Internodes of a branch" })

local Base, Apex = module("Base", "age"), module("Apex", "age")
local Internode = module("Internode", "florigen", "release")
local Bud, Shoot, Flower = module("Bud"), module("Shoot", "age", "internodes"), module("Flower")

local plant = lsystem({ object = turtle({ angle = 45, width = 0.3, color = "#7aa860" }), interpret = "last" })
plant:ignore("Left", "Roll")
plant:axiom(Base(0), Internode(0, 0), Apex(0))

plant:rule("Internode(f, r) < Apex(age)", function(this, f, r, age)
  if f == 1 then
    return Flower()
  elseif age == 0 then
    return Apex(1)
  end
  return { Left(), Bud() }, Internode(0, 0), Roll(180), Apex(0)
end)
plant:rule("Base(age)", function(this, age: number)
  return Base(age + 1)
end)
plant:rule("Base(age) < Internode(f, r)", {
  when = function(this, age)
    return age == delay
  end,
}, function(this, age, f, r)
  return Internode(1, r)
end)

-- Florigen comes from below, the release of the buds from above. The last internode answers to the flower.
plant:rule("Internode(f, r) > Flower", function(this, f)
  return Internode(f, 1)
end)
plant:rule(
  "Internode(below, a) < Internode(f, r) > Internode(g, above)",
  function(this, below, a, f, r, g, above)
    return Internode(below, above)
  end
)
plant:rule("Internode(below, a) < Internode(f, r) > Apex", function(this, below, a, f, r)
  return Internode(below, r)
end)
plant:rule("Base < Internode(f, r) > Internode(g, above)", function(this, f, r, g, above)
  return Internode(f, above)
end)

plant:rule("Internode(f, r) < Bud", {
  when = function(this, f, r)
    return r == 1
  end,
}, function()
  return Shoot(0, 0)
end)
plant:rule("Shoot(age, n)", function(this, age, n)
  if age == 0 then
    return Shoot(1, n)
  elseif n < total then
    return F(1), Shoot(0, n + 1)
  end
  return Flower()
end)

plant:interpret("Internode(f, r)", function(this, f, r)
  return Color(if r == 1 then "#4763b0" elseif f == 1 then "#d8402f" else "#7aa860"), F(1)
end)
plant:interpret("Bud", function()
  return Color("#4d6b3a"), Sphere(0.3)
end)
plant:interpret("Flower", function()
  return Color("#e8b923"), Sphere(0.7)
end)
local result = plant:derive(steps)

-- The apex flowers in step 32 above 16 internodes. The second signal is k internodes further down k steps after
-- step 33. It wakes a bud one step later, and the branch flowers after 8 more steps: 8 branches until step 50.
expect(result.counts.Internode, 16)
expect(result.counts.Flower, 1 + 8)
-- Picture: --azimuth 180 --elevation 0
