--!strict
-- A palm that sheds its leaves: they bend down with age and fall, until the apex ends in an inflorescence.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Shedding, University of Calgary.
local steps = param("steps", { default = 320, min = 0, max = 600, step = 1, doc = "Steps of growth" })
local plastochron = param(
  "plastochron",
  { default = 6, min = 2, max = 20, step = 1, unit = "steps", doc = "From leaf to leaf" }
)
local life =
  param("life", { default = 120, min = 1, max = 300, step = 1, unit = "steps", doc = "Life of a leaf" })
local flowering = param(
  "flowering",
  { default = 260, min = 1, max = 500, step = 1, unit = "steps", doc = "Time of flowering" }
)
local bend =
  param("bend", { default = 0.78, min = 0, max = 1.5, unit = "deg", doc = "Bending of a leaf in a step" })

local Apex, Leaf, Scar, Flower =
  module("Apex"), module("Leaf", "age"), module("Scar"), module("Flower", "age")

local palm = lsystem({ object = turtle({ width = 6, color = "#8a6d4a" }), interpret = "last" })
palm:axiom(Apex())
palm:rule("Apex", function()
  if step() >= flowering then
    return Flower(0)
  elseif step() % plastochron > 0 then
    return F(1), Apex()
  end
  return F(1), { Leaf(0) }, Roll(180), Apex()
end)
palm:rule("Leaf(age)", function(this, age)
  return if age < life then Leaf(age + 1) else Scar()
end)
palm:rule("Flower(age)", function(this, age: number)
  return Flower(age + 1)
end)
palm:interpret("Leaf(age)", function(this, age)
  return Turn(-bend * age), Width(4), Color(mix("#7fae3a", "#b98b2c", age / life)), F(age)
end)
palm:interpret("Scar", function()
  return Color("#5d4630"), Sphere(4)
end)
palm:interpret("Flower(age)", function(this, age)
  local size = age / 5
  return Color("#d8532f"),
    BeginPolygon(),
    Point(),
    { Turn(72), G(size), Point() },
    { G(10 * size), Point() },
    { Turn(-72), G(size), Point() },
    EndPolygon()
end)
local result = palm:derive(steps)

-- The leaves 1 to 43 appear in the steps 6 to 258. Those of step 199 and before are older than 120 steps.
expect(result.counts.Leaf, 10)
expect(result.counts.Scar, 33)
-- The stem grows by 1 in each of 259 steps.
expect(result.objects[1]:position().z, 259, 1e-9)
-- Picture: --azimuth 180 --elevation 0
