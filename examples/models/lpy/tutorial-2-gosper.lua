--!strict
-- The Gosper curve (flowsnake), which fills an island of hexagons: each edge becomes seven edges.
-- Source: L-Py, tutorial/02 - fractals/gosper, F. Boudon and C. Godin.
local steps = param("steps", { default = 3, min = 0, max = 5, step = 1, doc = "Steps" })
local low = param("low", { default = "#2f5fa8", doc = "Colour of the left edges" })
local high = param("high", { default = "#c0562f", doc = "Colour of the right edges" })

local LeftEdge, RightEdge = module("LeftEdge"), module("RightEdge")

local curve = lsystem({ object = turtle({ angle = 60, width = 0.28, sides = 6 }), interpret = "last" })
curve:axiom(LeftEdge())
curve:rule("LeftEdge", function()
  local a, b = LeftEdge(), RightEdge()
  return a, Left(), b, Left(120), b, Right(), a, Right(120), a, a, Right(), b, Left()
end)
curve:rule("RightEdge", function()
  local a, b = LeftEdge(), RightEdge()
  return Right(), a, Left(), b, b, Left(120), b, Left(), a, Right(120), a, Right(), b
end)
curve:interpret("LeftEdge", function()
  return Color(low), F(1)
end)
curve:interpret("RightEdge", function()
  return Color(high), F(1)
end)
local result = curve:derive(steps)

-- Seven edges for one, and the distance of the ends grows by sqrt(7).
expect(result.counts.LeftEdge + result.counts.RightEdge, 7 ^ 3)
expect(result.objects[1]:position():length(), 7 ^ 1.5, 1e-9)
-- Picture: --azimuth 180 --elevation 0
