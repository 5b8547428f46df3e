--!strict
-- Moore's curve: four Hilbert curves that close to a loop.
-- Source: E. Moore, On certain crinkly curves, 1900.
local steps =
  param("steps", { default = 4, min = 1, max = 6, step = 1, doc = "How often the square is divided" })
local color = param("color", { default = "#3f7a4a", doc = "Colour of the curve" })

local Cup = module("Cup", "side") -- side is 1 for left, -1 for right

local curve = lsystem({ object = turtle({ width = 0.35, color = color, sides = 6 }), interpret = "last" })
curve:axiom(
  Cup(1),
  F(1),
  Cup(1),
  Right(90),
  F(1),
  Right(90),
  Cup(1),
  F(1),
  Cup(1),
  Right(90),
  F(1),
  Right(90)
)
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
local result = curve:derive(steps - 1)

-- The loop visits 4^n cells, so it has as many edges, and ends where it began.
expect(result.counts.F, 4 ^ 4)
expect(result.objects[1]:position():length(), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
