-- A quarter turn over 2 m.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:rectangle(1.4, 0.5):resolution(24, 0):twist(0):extrude(1)
  this:color("orange"):twist(90):extrude(2)
end)
parts:derive()
