--!strict
-- The Sierpinski triangle of filled triangles, along the arrowhead curve.
-- Source: L-Py, training/04-sierpinski, F. Boudon and C. Godin.
local steps = param("steps", { default = 5, min = 0, max = 7, step = 1, doc = "Steps" })
local color = param("color", { default = "#c0392b", doc = "Colour of the triangles" })

local LeftSide, RightSide = module("LeftSide", "length"), module("RightSide", "length") -- side of the triangle

local curve = lsystem({ object = turtle({ angle = 60, color = color }), interpret = "last" })
curve:axiom(Right(90), LeftSide(1))
curve:rule("LeftSide(x)", function(this, x: number)
  return Left(), RightSide(x / 2), Right(), LeftSide(x / 2), Right(), RightSide(x / 2), Left()
end)
curve:rule("RightSide(x)", function(this, x: number)
  return Right(), LeftSide(x / 2), Left(), RightSide(x / 2), Left(), LeftSide(x / 2), Right()
end)
local function triangle(x: number, side: number)
  return { BeginPolygon(), Point(), G(x), Point(), Turn(120 * side), G(x), Point(), EndPolygon() }, G(x)
end
curve:interpret("LeftSide(x)", function(this, x)
  return triangle(x, 1)
end)
curve:interpret("RightSide(x)", function(this, x)
  return triangle(x, -1)
end)
local result = curve:derive(steps)

-- Each triangle becomes three of half the size. The curve runs along the lower side.
expect(result.counts.LeftSide + result.counts.RightSide, 3 ^ 5)
expect(result.objects[1]:position():distance(vec(1, 0, 0)), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
