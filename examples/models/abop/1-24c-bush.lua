--!strict
-- A weed by edge rewriting, with curved branches of three segments.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24c.
local steps = param("steps", { default = 4, min = 1, max = 5, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 22.5, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local segment =
  param("segment", { default = 0.04, min = 0.01, max = 1, unit = "m", doc = "Length of a segment" })

local pen = turtle({ step = segment, angle = angle, width = segment / 3, color = "#47742f", sides = 4 })
local bush = abop({ axiom = "F", F = "FF-[-F+F+F]+[+F-F-F]", object = pen })

local derived = bush:derive(steps)
-- Eight segments replace a segment; two of them are on the axis, whose turns cancel out.
expect(derived.counts.F, 8 ^ 4)
expect(derived.objects[1]:position().z, 0.04 * 2 ^ 4, 1e-9)

-- Picture: --azimuth 180 --elevation 0
