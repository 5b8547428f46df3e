--!strict
-- Tropism: shoots that start in different directions bend upwards with each step.
-- Source: L-Py, tutorial/01 - turtle/09 - tropism, F. Boudon and C. Godin.
local shoots = param("shoots", { default = 7, min = 1, max = 15, step = 1, doc = "Number of shoots" })
local elasticity =
  param("elasticity", { default = 0.02, min = -0.1, max = 0.1, doc = "Strength of the bending" })
local steps = param("steps", { default = 60, min = 1, max = 200, step = 1, doc = "Segments of a shoot" })

local Shoot = module("Shoot")

local plant = lsystem({ object = turtle({ color = "#5f8f3c", tropism = { 0, 0, 1 } }) })
local function fan(last: number)
  local chain: any = { Width(0.03) }
  for k = 1, shoots do
    local angle = if shoots == 1 then 90 else -90 + 180 * (k - 1) / (shoots - 1)
    table.insert(chain, { Turn(angle), Shoot() })
  end
  table.insert(chain, Turn(last))
  table.insert(chain, Shoot())
  return table.unpack(chain)
end
plant:axiom(fan(90))
plant:interpret("Shoot", function(this)
  this:elasticity(elasticity)
  for _ = 1, steps do
    this:forward(1 / steps)
  end
end)
local result = plant:derive(0)

-- Each step turns the heading by e sin(a), where a is its angle to the tropism. In the limit of many small steps,
-- tan(a / 2) = exp(-n e) after n steps from the horizontal.
local height = math.cos(2 * math.atan(math.exp(-60 * 0.02)))
expect(result.objects[1]:heading().z, height, 0.01)
-- Picture: --azimuth 180 --elevation 0
