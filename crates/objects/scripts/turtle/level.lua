-- After level, a turn to the left is horizontal.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:pitch(50):roll(70):forward(1):level():color("orange"):turn(90):forward(1)
end)
parts:derive()
