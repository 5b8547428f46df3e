--!strict
-- A bush by edge rewriting: each segment becomes an axis of three segments with two branches.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24a.
local steps = param("steps", { default = 5, min = 1, max = 6, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 25.7, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local height = param("height", { default = 2, min = 0.1, max = 20, unit = "m", doc = "Height of the plant" })

local pen =
  turtle({ step = height / 3 ^ steps, angle = angle, width = height / 220, color = "#47742f", sides = 4 })
local bush = abop({ axiom = "F", F = "F[+F]F[-F]F", object = pen })

local derived = bush:derive(steps)
-- Five segments replace a segment; three of them are on the axis, which therefore has 3^5 segments.
expect(derived.counts.F, 5 ^ 5)
expect(derived.objects[1]:position().z, 2, 1e-9)

-- Picture: --azimuth 180 --elevation 0
