--!strict
-- Signals in a branching structure, red: from the base to the tips above, from the tip to the base below. Each picture
-- of a row is one step later.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.30.
local angle = param("angle", { default = 45, min = 10, max = 80, unit = "deg", doc = "Of the branches" })

local Segment, Signal = module("Segment"), module("Signal")

local function tree(pattern: string, step: number, z: number): number
  local pen = turtle({ angle = angle, width = 0.16, position = { step * 3, 0, z } })
  local system = lsystem({ object = pen, interpret = "last" })
  local stem = "Segment [+Segment] Segment [-Segment] Segment [+Segment] Segment"
  -- The signal begins at the base, or at the tip.
  local first = if pattern == "Signal < Segment" then "^Segment" else "Segment$"
  system:axiom((stem:gsub(first, "Signal")))
  system:ignore("+-")
  system:rule(pattern, "Signal")
  system:interpret("Segment", function(this)
    this:color("#4c7a34"):forward()
  end)
  system:interpret("Signal", function(this)
    this:color("#c8352f"):forward()
  end)
  return system:derive(step).counts.Signal
end

for step = 0, 3 do
  -- To the tips, the signal takes a segment of the axis and the branch below it: 1, 3, 5, 7.
  expect(tree("Signal < Segment", step, 5), 1 + 2 * step)
  -- To the base, it passes the branches: the path to the base has one segment more in each step.
  expect(tree("Segment > Signal", step, 0), 1 + step)
end

-- Picture: --azimuth 180 --elevation 0
