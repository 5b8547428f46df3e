-- Segments of 1 m, 0.5 m and 0.25 m.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 6, smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:extrude(1):color("orange"):extrude(0.5):color("#7fa650"):extrude(0.25)
end)
parts:derive()
