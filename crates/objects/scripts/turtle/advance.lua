-- The gap is 0.6 m.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(0.6):advance(0.6):color("orange"):forward(0.6)
end)
parts:derive()
