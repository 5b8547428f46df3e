-- Steps of 1 m, 0.5 m and 0.25 m.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):color("orange"):forward(0.5):color("#7fa650"):forward(0.25)
end)
parts:derive()
