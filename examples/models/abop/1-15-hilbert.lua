--!strict
-- The Hilbert curve by node rewriting: a tile becomes four tiles, joined by three edges.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.15.
local steps = param("steps", { default = 5, min = 1, max = 7, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the square" })

local edge = size / (2 ^ steps - 1)
local pen = turtle({ step = edge, width = edge / 3, color = "#2f6b4f", sides = 4 })
-- L is a tile, and R its mirror image.
local curve = abop({ axiom = "L", L = "+RF-LFL-FR+", R = "-LF+RFR+FL-", object = pen })

local derived = curve:derive(steps)
-- One edge less than the 4^5 tiles; the ends are the first and the last tile of one side.
expect(derived.counts.F, 4 ^ 5 - 1)
expect(derived.objects[1]:position():length(), 10, 1e-9)

-- Picture: --azimuth 180 --elevation 0
