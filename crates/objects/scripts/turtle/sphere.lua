-- A sphere with a radius of 0.3 m at the turtle's position.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):color("orange"):sphere(0.3)
end)
parts:derive()
