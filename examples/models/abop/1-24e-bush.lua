--!strict
-- A plant by node rewriting with opposite branches.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24e.
local steps = param("steps", { default = 7, min = 1, max = 8, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 25.7, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local height = param("height", { default = 2, min = 0.1, max = 20, unit = "m", doc = "Height of the plant" })

local segment = height / (2 ^ (steps + 1) - 2)
local pen = turtle({ step = segment, angle = angle, width = height / 150, color = "#47742f", sides = 4 })
local plant = abop({ axiom = "X", X = "F[+X][-X]FX", F = "FF", object = pen })

local derived = plant:derive(steps)
-- Three apices X replace an apex. Segments: s(n + 1) = 2 s(n) + 2 * 3^n, so s(n) = 2 (3^n - 2^n).
expect({ derived.counts.X, derived.counts.F }, { 3 ^ 7, 2 * (3 ^ 7 - 2 ^ 7) })
-- On the axis: h(n + 1) = 2 h(n) + 2, so h(n) = 2^(n + 1) - 2.
expect(derived.objects[1]:position().z, 2, 1e-9)

-- Picture: --azimuth 180 --elevation 0
