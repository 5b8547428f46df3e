--!strict
-- A flowering herb: The Algorithmic Beauty of Plants, section 3.3. First the apex creates leaves and buds. Then it
-- becomes a flower and sends a signal down the stem, one internode per step. The signal turns buds into flowers, so
-- the uppermost flowers open first and the lowest are the youngest.
local age =
  param("age", { default = 27, min = 1, max = 48, step = 1, unit = "days", doc = "Steps of growth" })
local flowering =
  param("flowering", { default = 14, min = 2, max = 24, step = 1, unit = "days", doc = "When it flowers" })
local angle =
  param("angle", { default = 52, min = 20, max = 80, unit = "deg", doc = "Between the stem and its leaves" })
local petals = param("petals", { default = "#8377dd", doc = "Colour of the flowers" })

local Seed = module("Seed", "day") -- dormant for some days
local Apex = module("Apex", "day")
local Internode = module("Internode", "age", "signal") -- signal is 1 after the signal has passed
local Leaf = module("Leaf", "age")
local Bud = module("Bud")
local Stalk = module("Stalk", "age")
local Flower = module("Flower", "age")

-- A blade in strips on both sides of a rib of 1 m, which bends by `arch` (degrees) over its length.
local Rib = module("Rib", "k", "arch", "width")
local function blade(color, arch: number, width: number)
  local system = lsystem({ object = turtle({ color = color, roughness = 0.65 }) })
  system:axiom(Rib(0, arch, width))
  system:rule("Rib(k, arch, width)", function(this, k: number, arch, width)
    if k == 6 then
      return nil
    end
    local near = width * math.sin(math.pi * (k / 6) ^ 0.8)
    local far = if k == 5 then 0 else width * math.sin(math.pi * ((k + 1) / 6) ^ 0.8)
    local function strip(side: number): any
      return {
        Roll(side * 16),
        BeginPolygon(),
        Point(),
        { Turn(side * 90), G(near), Point() },
        { G(1 / 6), Turn(side * 90), G(far), Point() },
        { G(1 / 6), Point() },
        EndPolygon(),
      }
    end
    return strip(1), strip(-1), G(1 / 6), Pitch(arch / 6), Rib(k + 1, arch, width)
  end)
  return system:derive()
end
local green = blade("#5f9140", 70, 0.2)
local sepal = blade("#7aa04b", 20, 0.14)
local petal = blade(petals, 50, 0.33)

-- The flower in five stages, from closed to open.
local flowers = {}
for stage = 1, 5 do
  local open = lerp(8, 62, (stage - 1) / 4)
  local whorl = {}
  for k = 1, 5 do
    table.insert(whorl, { Roll(k * 72), Pitch(open), Place(petal, 1) })
    table.insert(whorl, { Roll(k * 72 + 36), Pitch(open + 20), Place(sepal, 0.55) })
  end
  local flower = lsystem({ object = turtle({ color = "#f0c94a", sides = 6 }) })
  flower:axiom({ G(0.12), Sphere(0.13) }, table.unpack(whorl))
  table.insert(flowers, flower:derive())
end

-- Three plants, sown some days apart.
local sown = source({
  { id = "first", day = 0, place = { -0.27, 0, 0 } },
  { id = "second", day = 5, place = { 0, -0.1, 0 } },
  { id = "third", day = 11, place = { 0.25, 0, 0 } },
})
local herb = lsystem({ object = turtle({}), interpret = "last" })
herb:ignore("Roll", "Pitch")
herb:axiom(sown, function(seed)
  return turtle({ color = "#6f9a48", position = seed.place }), Roll(seed.day * 40), Seed(seed.day)
end)

herb:rule("Seed(day)", function(this, day)
  return if day > 0 then Seed(day - 1) else Apex(1)
end)

herb:rule("Apex(day)", function(this, day)
  if day >= flowering then
    return Internode(0, 1), Flower(0)
  end
  return Internode(0, 0),
    { Pitch(angle), Leaf(0) },
    { Pitch(-angle), Roll(180), Leaf(0) },
    { Pitch(angle * 0.6), Bud() },
    { Pitch(-angle * 0.6), Roll(180), Bud() },
    Roll(137.5),
    Apex(day + 1)
end)

-- The signal comes from the internode above and continues to the bud next to it.
herb:rule("Internode(a, s) > Internode(b, t)", {
  when = function(this, a, s, b, t)
    return s < t
  end,
}, function(this, a)
  return Internode(a + 1, 1)
end)
herb:rule("Internode(a, s)", function(this, a: number, s)
  return Internode(a + 1, s)
end)
herb:rule("Internode(a, s) < Bud", {
  when = function(this, a, s)
    return s == 1
  end,
}, function()
  return Stalk(0), Flower(0)
end)

-- Size increases with age.
herb:rule("Leaf(a)", function(this, a: number)
  return Leaf(a + 1)
end)
herb:rule("Stalk(a)", function(this, a: number)
  return Stalk(a + 1)
end)
herb:rule("Flower(a)", function(this, a: number)
  return Flower(a + 1)
end)

local function grown(a: number, days: number): number
  return ease.sine(math.min((a + 1) / (days + 1), 1))
end
herb:interpret("Internode(a, s)", function(this, a)
  this:width(0.004 + 0.006 * grown(a, 24)):forward(0.04 * grown(a, 8))
end)
herb:interpret("Leaf(a)", function(this, a)
  this:width(0.004):forward(0.03 * grown(a, 8))
  this:place(green, 0.17 * grown(a, 16))
end)
herb:interpret("Stalk(a)", function(this, a)
  this:width(0.004):forward(0.07 * grown(a, 8))
end)
herb:interpret("Bud", function(this)
  this:width(0.003):forward(0.012)
  this:place(flowers[1], 0.016)
end)
herb:interpret("Flower(a)", function(this, a)
  this:width(0.003):forward(0.01)
  this:place(flowers[math.clamp(math.floor(a / 2) + 1, 1, 5)], 0.018 + 0.045 * grown(a, 8))
end)

herb:derive(age)
