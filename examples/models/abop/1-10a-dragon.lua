--!strict
-- The dragon curve by edge rewriting: edges that take the left side alternate with edges that take the right side.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.10a.
local rewrite_edges = require("shared/edges")

local steps = param("steps", { default = 10, min = 0, max = 13, step = 1, doc = "Steps of the derivation" })
local size =
  param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "From one end to the other" })

local edge = size / math.sqrt(2) ^ steps
local pen = turtle({ step = edge, width = edge / 3, color = "#b8452f", sides = 4 })
local plant = { axiom = "L", L = "L+R+", R = "-L-R", object = pen }

local derived = rewrite_edges(plant, steps)
-- Each step doubles the edges, and an edge is the diagonal of the two that replace it.
expect(derived.counts.L + derived.counts.R, 2 ^ 10)
-- Ten eighths of a turn later, the curve ends to the left of its start.
expect(derived.objects[1]:position():distance(vec(-10, 0, 0)), 0, 1e-9)

-- Picture: --azimuth 180 --elevation 0
