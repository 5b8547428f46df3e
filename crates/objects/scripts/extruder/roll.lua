-- A roll of 30 degrees.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:rectangle(1.4, 0.5):extrude(1)
  this:color("orange"):roll(30):extrude(1)
end)
parts:derive()
