--!strict
-- A fern after Barnsley: each apex makes a piece of the axis with two fronds, and the axis curls.
-- Source: L-Py, tutorial/02 - fractals/barnsleyfern, F. Boudon and C. Godin.
local steps = param("steps", { default = 7, min = 0, max = 8, step = 1, doc = "Steps of growth" })
local ratio =
  param("ratio", { default = 1.8, min = 1.2, max = 3, doc = "Length of an axis by that of its fronds" })
local curl =
  param("curl", { default = 5, min = -20, max = 20, unit = "deg", doc = "Turn between two fronds" })

local Apex = module("Apex", "size")

local fern = lsystem({ object = turtle({ width = 0.006, color = "#3f8a3a", sides = 5 }), interpret = "last" })
fern:axiom(Apex(1))
fern:rule("Apex(s)", function(this, s: number)
  local frond = Apex(s / ratio)
  return F(s / 5),
    Turn(-curl),
    { Turn(45), frond },
    F(s / 10),
    Turn(-curl),
    { Roll(180), Turn(45), frond },
    F(s / 5),
    frond
end)
local result = fern:derive(steps)

-- The number of apices triples, and each of them has made three segments.
expect(result.counts.Apex, 3 ^ 7)
expect(result.counts.F, 3 * (3 ^ 7 - 1) / 2)
-- Picture: --azimuth 180 --elevation 0
