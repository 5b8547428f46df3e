-- A roll shows in the next turn to the left: orange after roll, green after roll_back.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):roll(40):turn(60):color("orange"):forward(1)
  this:jump({ 0, 0, 1 }):face({ 0, 0, 1 }):roll_back(80):turn(60):color("#7fa650"):forward(1)
end)
parts:derive()
