--!strict
-- The Sierpinski gasket as one curve, by edge rewriting with two kinds of edges.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.10b.
local rewrite_edges = require("shared/edges")

local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the triangle" })

local pen = turtle({ step = size / 2 ^ steps, angle = 60, width = size / 120, color = "#1f4e79", sides = 4 })
-- The first turn puts the triangle on its base.
local plant = {
  axiom = if steps % 2 == 0 then "-(90)R" else "-(150)R",
  L = "R+L+R",
  R = "L-R-L",
  object = pen,
}

local derived = rewrite_edges(plant, steps)
-- Three edges of half the length replace an edge and end where it ended.
expect(derived.counts.L + derived.counts.R, 3 ^ 6)
expect(derived.objects[1]:position():length(), 10, 1e-9)

-- Picture: --azimuth 180 --elevation 0
