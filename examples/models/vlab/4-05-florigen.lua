--!strict
-- Florigen: after a delay, the base of the plant sends a signal upwards, which turns the growing apex into a flower.
-- Source: Virtual Laboratory (cpfg), Signaling/05-florigen-param, University of Calgary.
local steps = param("steps", { default = 26, min = 0, max = 40, step = 1, doc = "Steps of growth" })
local delay =
  param("delay", { default = 15, min = 1, max = 30, step = 1, unit = "steps", doc = "Delay of the signal" })

local Base, Apex, Flower = module("Base", "age"), module("Apex", "age"), module("Flower")
local Internode = module("Internode", "florigen") -- florigen is 1 in reached internodes

local plant = lsystem({ object = turtle({ width = 0.4, sides = 12 }), interpret = "last" })
plant:axiom(Base(0), Internode(0), Apex(0))
plant:rule("Base(age)", function(this, age: number)
  return Base(age + 1)
end)
plant:rule("Internode(florigen) < Apex(age)", function(this, florigen, age)
  if florigen == 1 then
    return Flower()
  elseif age == 0 then
    return Apex(1)
  end
  return Internode(0), Apex(0)
end)
plant:rule("Base(age) < Internode(florigen)", {
  when = function(this, age)
    return age == delay
  end,
}, function()
  return Internode(1)
end)
plant:rule("Internode(below) < Internode(florigen)", function(this, below)
  return Internode(below)
end)
plant:interpret("Internode(florigen)", function(this, florigen)
  return Color(if florigen == 1 then "#d8402f" else "#7aa860"), F(1), { Color("#4d6b3a"), Sphere(0.26) }
end)
plant:interpret("Apex", function()
  return Color("#4fa34d"), F(0.6)
end)
plant:interpret("Flower", function()
  return G(1), Color("#e8b923"), Sphere(1.2)
end)
local young = plant:derive(steps)

-- An internode appears in every second step. The signal enters in step 16 and climbs one internode per step.
expect(young.counts.Internode, 1 + 26 // 2)
expect(select(2, young.chains[1]:gsub("Internode%(1%)", "")), 26 - 15)
-- Picture: --azimuth 180 --elevation 0
