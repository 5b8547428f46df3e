-- Back over half of the last segment.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):turn(30):forward(1):turn_around():color("orange"):width(0.25):forward(0.5)
end)
parts:derive()
