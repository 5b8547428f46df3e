--!strict
-- Decussate branching: each pair of branches is perpendicular to the pair below.
-- Source: Virtual Laboratory (cpfg), Mod-vis-3D/02-decussate, University of Calgary.
local time = param("time", { default = 8, min = 0, max = 10, doc = "Age of the plant" })
local delay = param("delay", { default = 2, min = 1, max = 4, doc = "Age at which an apex branches" })
local growth =
  param("growth", { default = 1.5, min = 1, max = 2, doc = "Growth of internodes per unit of time" })

local Apex = module("Apex", "age")

local plant = lsystem({ object = turtle({ angle = 45, width = 0.4 }) })
plant:axiom(Apex(time))
plant:interpret("Apex(age)", function(this, age)
  if age < delay then
    return Color("#7fb850"), F(age)
  end
  local young = age - delay
  local half = F(growth ^ young / 2)
  return Roll(90),
    Color("#5f7f35"),
    half,
    { Left(), Apex(young) },
    { Right(), Apex(young) },
    half,
    Apex(age - 1)
end)
local tree = plant:derive(0)

-- Seven metamers of lengths 1.5^0 to 1.5^6 and an apex of length 1; seven quarter turns leave the left side at -y.
local tip = tree.objects[1]
expect(tip:position().z, (1.5 ^ 7 - 1) / 0.5 + 1, 1e-6)
expect(math.abs(tip:left().y), 1, 1e-9)
