-- A module with two parameters; the second is optional.
local Floor = module("Floor", "height", "setback?")
local house = lsystem({ object = extruder({ sides = 4 }) })
house:axiom(Floor(4), Floor(3, 0.9))
house:interpret("Floor(height, setback)", function(this, height, setback)
  this:scale(setback or 1):extrude(height)
end)
house:derive()
