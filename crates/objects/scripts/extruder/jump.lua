-- Jumps to (2, 0, 0) and to (2, 2, 0).
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 6, smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:scale(0.4):extrude(0.5)
  this:color("orange"):jump({ 2, 0, 0 }):extrude(1):jump({ 2, 2, 0 }):extrude(1.5)
end)
parts:derive()
