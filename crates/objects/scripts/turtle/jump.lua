-- A jump to (1, 0, 0).
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:forward(1):jump({ 1, 0, 0 }):color("orange"):forward(1)
end)
parts:derive()
