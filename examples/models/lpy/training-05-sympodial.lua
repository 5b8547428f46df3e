--!strict
-- A sympodial plant: each apex becomes a flower between two branches.
-- Source: L-Py, training/05-simple-sympodial-plant, F. Boudon and C. Godin.
local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps of growth" })
local angle = param("angle", { default = 30, min = 5, max = 60, unit = "deg", doc = "Angle of the branches" })
local shorter =
  param("shorter", { default = 0.85, min = 0.5, max = 1, doc = "Length of a branch by its parent" })

local Apex, Flower = module("Apex", "length"), module("Flower")

local plant =
  lsystem({ object = turtle({ width = 0.08, color = "#5f7f35", angle = angle }), interpret = "last" })
plant:axiom(Apex(1))
plant:rule("Apex(length)", function(this, length: number)
  local next = Apex(length * shorter)
  return F(length), { Left(), Roll(25), next }, { Right(), Roll(25), next }, F(0.2), Flower()
end)
plant:interpret("Flower", function()
  return Color("#d8402f"), Sphere(0.1)
end)
local result = plant:derive(steps)

-- The number of apices doubles, and each fork has a flower: 1 + 2 + ... + 32.
expect(result.counts.Apex, 2 ^ 6)
expect(result.counts.Flower, 2 ^ 6 - 1)
-- Picture: --azimuth 180 --elevation 10
