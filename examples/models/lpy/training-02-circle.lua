--!strict
-- A circle: decomposition divides it into straight pieces.
-- Source: L-Py, training/02-circle, F. Boudon and C. Godin.
local pieces = param("pieces", { default = 60, min = 3, max = 100, step = 1, doc = "Number of pieces" })
local radius = param("radius", { default = 1, min = 0.1, max = 10, unit = "m", doc = "Radius" })

local Arc = module("Arc", "pieces")

local circle = lsystem({ object = turtle({ width = radius * 0.06, color = "#4763b0" }) })
circle:axiom(Arc(pieces))
circle:decompose("Arc(n)", function(this, n: number)
  if n == 0 then
    return nil
  end
  local turn = 360 / pieces
  return Turn(turn / 2), F(2 * radius * math.sin(math.rad(turn / 2))), Turn(turn / 2), Arc(n - 1)
end)
local result = circle:derive(0)

-- The curve is closed, and its last heading is the first.
expect(result.counts.F, 60)
expect(result.objects[1]:position():length(), 0, 1e-9)
expect(result.objects[1]:heading().z, 1, 1e-9)
-- Picture: --azimuth 180 --elevation 0
