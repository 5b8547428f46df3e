--!strict
-- A plant by node rewriting, which leans to one side as if it grew in the wind.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24f.
local steps = param("steps", { default = 5, min = 1, max = 7, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 22.5, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local segment =
  param("segment", { default = 0.02, min = 0.001, max = 1, unit = "m", doc = "Length of a segment" })

local pen = turtle({ step = segment, angle = angle, width = segment / 2, color = "#47742f", sides = 4 })
local plant = abop({ axiom = "X", X = "F-[[X]+X]+F[+FX]-X", F = "FF", object = pen })

local derived = plant:derive(steps)
-- Four apices X replace an apex. Segments: s(n + 1) = 2 s(n) + 3 * 4^n, so s(n) = 3 (4^n - 2^n) / 2.
expect({ derived.counts.X, derived.counts.F }, { 4 ^ 5, 3 * (4 ^ 5 - 2 ^ 5) / 2 })

-- Picture: --azimuth 180 --elevation 0
