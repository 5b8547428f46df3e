--!strict
-- The Sierpinski curve: a closed line around the diagonals of a square, with four equal sides.
-- Source: W. Sierpinski, Sur une nouvelle courbe continue qui remplit toute une aire plane, 1912.
local steps = param("steps", { default = 4, min = 0, max = 6, step = 1, doc = "Steps" })
local color = param("color", { default = "#8f5a2f", doc = "Colour of the curve" })

local Side = module("Side")
local DIAGONAL = math.sqrt(2) -- the lines along the sides of the square, by the diagonal ones

local curve =
  lsystem({ object = turtle({ angle = 45, width = 0.4, color = color, sides = 6 }), interpret = "last" })
curve:axiom(F(1), Right(90), Side(), F(1), Right(90), F(1), Right(90), Side(), F(1), Right(90))
curve:rule("Side", function()
  local piece = Side()
  return piece,
    F(1),
    Left(),
    F(DIAGONAL),
    Left(),
    piece,
    F(1),
    Right(90),
    F(1),
    Right(90),
    piece,
    F(1),
    Left(),
    F(DIAGONAL),
    Left(),
    piece
end)
local result = curve:derive(steps)

-- The number of sides becomes four times as large, and each of them has made six lines; the curve is closed.
expect(result.counts.Side, 2 * 4 ^ 4)
expect(result.counts.F, 4 + 6 * 2 * (4 ^ 4 - 1) / 3)
expect(result.objects[1]:position():length(), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
