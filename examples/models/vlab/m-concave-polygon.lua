--!strict
-- A filled fractal polygon: a closed curve of two kinds of edges, of which only the short ones are drawn.
-- Source: Virtual Laboratory (cpfg), CPFG manual, ConcavePolygons, University of Calgary.
local steps = param("steps", { default = 7, min = 0, max = 9, step = 1, doc = "Steps" })
local color = param("color", { default = "#b5482f", doc = "Colour of the polygon" })

local LeftEdge, RightEdge, Short = module("LeftEdge"), module("RightEdge"), module("Short")

local curve = lsystem({ object = turtle({ angle = 45, color = color }), interpret = "last" })
curve:axiom(
  BeginPolygon(),
  Point(),
  LeftEdge(),
  Right(90),
  Short(),
  Right(90),
  LeftEdge(),
  Right(90),
  Short(),
  Right(90),
  EndPolygon()
)
curve:rule("LeftEdge", function()
  return Left(), RightEdge(), Right(), Short(), Right(), RightEdge(), Left()
end)
curve:rule("RightEdge", function()
  return Right(), LeftEdge(), Left(), Short(), Left(), LeftEdge(), Right()
end)
curve:interpret("Short", function()
  return G(1), Point()
end)
local result = curve:derive(steps)

-- The number of long edges doubles, and each of them makes a short one: 2 + 2 + 4 + ... + 128. The curve is closed.
expect(result.counts.Short, 2 ^ 8)
expect(result.objects[1]:position():length(), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
