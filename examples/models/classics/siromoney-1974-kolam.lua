--!strict
-- Anklets of Krishna, a kolam of southern India: one closed line around the dots of a square grid.
-- Source: G. Siromoney, R. Siromoney and K. Krithivasan, Array grammars and kolam, 1974; as an L-system in
-- P. Prusinkiewicz and J. Hanan, Lindenmayer systems, fractals, and plants, 1989.
local steps = param("steps", { default = 3, min = 0, max = 5, step = 1, doc = "Steps" })
local color = param("color", { default = "#c03a4f", doc = "Colour of the line" })

local Loop = module("Loop")

local kolam =
  lsystem({ object = turtle({ angle = 45, width = 0.25, color = color, sides = 6 }), interpret = "last" })
kolam:axiom(Right(), Loop(), Right(90), Loop(), Right())
kolam:rule("Loop", function()
  return Loop(), F(1), Loop(), Right(90), Loop(), F(1), Loop()
end)
local result = kolam:derive(steps)

-- Each loop becomes four, with two edges: 2 (1 + 4 + 16) pairs. The line is closed.
expect(result.counts.F, 2 * 2 * (1 + 4 + 16))
expect(result.objects[1]:position():length(), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
