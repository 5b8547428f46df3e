-- turn is orange, turn_right green.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):turn(40):color("orange"):forward(1)
  this:jump({ 0, 0, 1 }):face({ 0, 0, 1 }):turn_right(40):color("#7fa650"):forward(1)
end)
parts:derive()
