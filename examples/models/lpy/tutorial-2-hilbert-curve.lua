--!strict
-- The Hilbert curve through all cells of a square.
-- Source: L-Py, tutorial/02 - fractals/hilbert-curve, F. Boudon and C. Godin.
local steps =
  param("steps", { default = 4, min = 1, max = 7, step = 1, doc = "How often the square is divided" })
local color = param("color", { default = "#2f7f7a", doc = "Colour of the curve" })

local Cup = module("Cup", "side") -- side is 1 for left, -1 for right

local curve = lsystem({ object = turtle({ width = 0.35, color = color, sides = 6 }), interpret = "last" })
curve:axiom(Cup(1))
curve:rule("Cup(s)", function(this, s)
  return Turn(90 * s),
    Cup(-s),
    F(1),
    Turn(-90 * s),
    Cup(s),
    F(1),
    Cup(s),
    Turn(-90 * s),
    F(1),
    Cup(-s),
    Turn(90 * s)
end)
local result = curve:derive(steps)

-- The curve joins 4^n cells, and ends at a neighbouring corner of the square.
expect(result.counts.F, 4 ^ 4 - 1)
expect(result.objects[1]:position():length(), 2 ^ 4 - 1, 1e-9)
-- Picture: --azimuth 180 --elevation 0
