--!strict
-- A plant by node rewriting, which leans to one side as if it grew in the wind.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.24f.
local steps = param("steps", { default = 5, min = 1, max = 7, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 22.5, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local segment =
  param("segment", { default = 0.02, min = 0.001, max = 1, unit = "m", doc = "Length of a segment" })

local Apex = module("Apex")
local pen = turtle({ step = segment, angle = angle, width = segment / 2, color = "#47742f", sides = 4 })
local plant = lsystem({ object = pen, interpret = "last" })
plant:axiom(Apex())
plant:rule("Apex", function()
  return F(), Right(), { { Apex() }, Left(), Apex() }, Left(), F(), { Left(), F(), Apex() }, Right(), Apex()
end)
plant:rule("F", function()
  return F(), F()
end)

local derived = plant:derive(steps)
-- Four apices replace an apex. Segments: s(n + 1) = 2 s(n) + 3 * 4^n, so s(n) = 3 (4^n - 2^n) / 2.
expect({ derived.counts.Apex, derived.counts.F }, { 4 ^ 5, 3 * (4 ^ 5 - 2 ^ 5) / 2 })

-- Picture: --azimuth 180 --elevation 0
