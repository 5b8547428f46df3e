-- The second segment tapers from 0.3 m to 0.1 m.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:width(0.3):forward(1):width(0.1):forward(1):forward(0.5)
end)
parts:derive()
