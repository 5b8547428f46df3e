--!strict
-- A compound leaf with alternating leaflets: two kinds of apices create branches on the left and on the right.
-- Source: Virtual Laboratory (cpfg), Introduction/12-alternating, University of Calgary.
local time = param("time", { default = 16, min = 0, max = 18, doc = "Age of the leaf" })
local delay = param("delay", { default = 2.5, min = 1, max = 4, doc = "Age at which an apex branches" })
local growth =
  param("growth", { default = 1.3, min = 1, max = 1.6, doc = "Growth of internodes per unit of time" })

local Apex = module("Apex", "age", "side") -- side is 1 on the left, -1 on the right

local leaf = lsystem({ object = turtle({ width = 0.8 }) })
leaf:axiom(Apex(time, 1))
leaf:interpret("Apex(age, side)", function(this, age, side)
  if age < delay then
    return Color("#8a9a2f"), F(age)
  end
  local young = age - delay
  local half = F(growth ^ young / 2)
  return Color("#5f7f35"), half, { Turn(45 * side), Apex(young, side) }, half, Apex(age - 1, -side)
end)
local plant = leaf:derive(0)

-- Ages 16 to 3 make metamers of lengths 1.3^13.5 to 1.3^0.5; the last apex has the age and the length 2.
expect(plant.objects[1]:position().z, 1.3 ^ 0.5 * (1.3 ^ 14 - 1) / 0.3 + 2, 1e-6)
-- Picture: --azimuth 180 --elevation 0
