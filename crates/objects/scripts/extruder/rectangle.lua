-- At the start, upwards, the width is along x and the height along y.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:rectangle(2, 0.6):extrude(1)
  this:color("orange"):rectangle(0.6, 2):extrude(1)
end)
parts:derive()
