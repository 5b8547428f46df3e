--!strict
-- The leaf of 1-09 without a derivation: interpretations that return modules build it at once for any age.
-- Source: Virtual Laboratory (cpfg), Introduction/10-recursive, University of Calgary.
local time = param("time", { default = 8, min = 0, max = 10, doc = "Age of the leaf" })
local delay = param("delay", { default = 2, min = 1, max = 4, doc = "Age at which an apex branches" })
local growth =
  param("growth", { default = 1.5, min = 1, max = 2, doc = "Growth of internodes per unit of time" })
local angle = param("angle", { default = 45, min = 10, max = 80, unit = "deg", doc = "Branching angle" })

local Apex, Metamer = module("Apex", "age"), module("Metamer", "age")

local leaf = lsystem({ object = turtle({ angle = angle, width = 0.26 }) })
leaf:axiom(Apex(time))
leaf:interpret("Apex(age)", function(this, age)
  if age >= delay then
    return Metamer(age - delay), Apex(age - 1)
  end
  return Color("#3fa34d"), F(age)
end)
leaf:interpret("Metamer(age)", function(this, age)
  local half = F(growth ^ age / 2)
  return Color("#5f7f35"), half, { Left(), Apex(age) }, { Right(), Apex(age) }, half
end)
local plant = leaf:derive(0)

-- The chain is only the apex; the axis has seven metamers of lengths 1.5^0 to 1.5^6, and an apex of length 1.
expect(plant.modules, 1)
expect(plant.objects[1]:position().z, (1.5 ^ 7 - 1) / 0.5 + 1, 1e-6)
-- Picture: --azimuth 180 --elevation 0
