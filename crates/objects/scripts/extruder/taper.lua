-- A taper from 1 to 0.5, and a taper to an edge.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 4, smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:scale(1):taper(0.5):extrude(1.5)
  this:color("orange"):taper(0.5, 0.05):extrude(1)
end)
parts:derive()
