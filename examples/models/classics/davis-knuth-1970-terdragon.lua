--!strict
-- The terdragon: each edge becomes a zigzag of three edges.
-- Source: C. Davis and D. Knuth, Number representations and dragon curves, 1970.
local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps" })
local color = param("color", { default = "#2f6f8f", doc = "Colour of the curve" })

local curve =
  lsystem({ object = turtle({ angle = 120, width = 0.3, color = color, sides = 6 }), interpret = "last" })
curve:axiom(F(1))
curve:rule("F", function()
  return F(1), Left(), F(1), Right(), F(1)
end)
local result = curve:derive(steps)

-- The number of edges triples; the distance of the ends grows by sqrt(3), and the direction turns by 30 degrees.
expect(result.counts.F, 3 ^ 6)
expect(result.objects[1]:position():distance(vec(0, 0, -27)), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
