--!strict
-- The quadratic Gosper curve, or E-curve: 25 edges of a fifth replace an edge and visit each square of a 5 x 5 tile.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.11b.
local rewrite_edges = require("shared/edges")

local steps = param("steps", { default = 2, min = 0, max = 3, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the square" })

local edge = size / 5 ^ steps
local pen = turtle({ step = edge, width = edge / 3, color = "#2f6b4f", sides = 4 })
local plant = {
  axiom = "-R",
  L = "LL-R-R+L+L-R-RL+R+LLR-L+R+LL+R-LR-R-L+L+RR-",
  R = "+LL-R-R+L+LR+L-RR-L-R+LRR-L-RL+L+R-R-L+L+RR",
  object = pen,
}

local derived = rewrite_edges(plant, steps)
-- 25 edges replace an edge, and the curve runs along the side of the square from corner to corner.
expect(derived.counts.L + derived.counts.R, 25 ^ 2)
expect(derived.objects[1]:position():distance(vec(10, 0, 0)), 0, 1e-9)

-- Picture: --azimuth 180 --elevation 0
