-- The gap is 0.6 m.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 6, smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:extrude(0.6):advance(0.6):color("orange"):extrude(0.6)
end)
parts:derive()
