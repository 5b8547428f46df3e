--!strict
-- A plant by node rewriting: an apex becomes a fork of three apices, and each segment doubles its length.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24d.
local steps = param("steps", { default = 7, min = 1, max = 8, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 20, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local segment =
  param("segment", { default = 0.01, min = 0.001, max = 1, unit = "m", doc = "Length of a segment" })

local pen = turtle({ step = segment, angle = angle, width = segment * 1.4, color = "#47742f", sides = 4 })
local plant = abop({ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", object = pen })

-- Three apices X replace an apex. Segments: s(n + 1) = 2 s(n) + 2 * 3^n, so s(n) = 2 (3^n - 2^n).
expect(
  plant:derive(steps).counts,
  { X = 3 ^ 7, F = 2 * (3 ^ 7 - 2 ^ 7), Left = 3 ^ 7 - 1, Right = (3 ^ 7 - 1) / 2 }
)

-- Picture: --azimuth 180 --elevation 0
