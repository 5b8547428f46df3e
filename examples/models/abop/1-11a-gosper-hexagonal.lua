--!strict
-- The hexagonal Gosper curve, a space-filling curve by edge rewriting on the triangular grid.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.11a.
local rewrite_edges = require("shared/edges")

local steps = param("steps", { default = 4, min = 0, max = 5, step = 1, doc = "Steps of the derivation" })
local size =
  param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "From one end to the other" })

local edge = size / math.sqrt(7) ^ steps
local pen = turtle({ step = edge, angle = 60, width = edge / 3, color = "#2f6b4f", sides = 4 })
local plant = {
  axiom = "L",
  L = "L+R++R-L--LL-R+",
  R = "-L+RR++R+L--L-R",
  object = pen,
}

local derived = rewrite_edges(plant, steps)
-- Seven edges, shorter by the square root of seven, replace an edge and end where it ended.
expect(derived.counts.L + derived.counts.R, 7 ^ 4)
expect(derived.objects[1]:position():length(), 10, 1e-9)

-- Picture: --azimuth 180 --elevation 0
