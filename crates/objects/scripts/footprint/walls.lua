-- Walls of 3 m, with walls of 2 m on top.
local Part = module("Part")
local parts =
  lsystem({ object = footprint({ { 0, 0 }, { 12, 0 }, { 12, 5 }, { 7, 5 }, { 7, 9 }, { 0, 9 } }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:walls({ height = 3 }):walls({ height = 2, color = "orange" }):roof({ kind = "flat" })
end)
parts:derive()
