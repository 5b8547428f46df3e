--!strict
-- Differentiation: lateral apices start some stages later than the apex of their axis, and all end in a flower.
-- Source: L-Py, training/06a-simple-differentiation, F. Boudon and C. Godin.
local stages = param("stages", { default = 10, min = 1, max = 14, step = 1, doc = "Stages until flowering" })
local advance =
  param("advance", { default = 3, min = 1, max = 8, step = 1, doc = "Stages of a lateral apex" })

local Apex, Internode, Flower = module("Apex", "stage"), module("Internode", "stage"), module("Flower")

local plant = lsystem({ object = turtle({ width = 0.7, color = "#6f8f3f", angle = 45 }), interpret = "last" })
plant:axiom(Apex(0))
plant:rule("Apex(n)", function(this, n)
  if n >= stages then
    return Flower()
  end
  return Internode(n), { Turn(if n % 2 == 0 then 45 else -45), Apex(n + advance) }, Apex(n + 1)
end)
plant:interpret("Internode(n)", function(this, n)
  return F(stages - n)
end)
plant:interpret("Flower", function()
  return F(1), Color("#d8402f"), Sphere(1)
end)
local result = plant:derive(stages + 1)

-- The number of flowers of an apex satisfies f(n) = f(n + 3) + f(n + 1), with f = 1 at the end.
local function flowers(n: number): number
  return if n >= 10 then 1 else flowers(n + 3) + flowers(n + 1)
end
expect(result.counts.Flower, flowers(0))
-- The main axis has internodes of 10 to 1 and the stalk of its flower.
expect(result.objects[1]:position().z, 56, 1e-9)
-- Picture: --azimuth 180 --elevation 0
