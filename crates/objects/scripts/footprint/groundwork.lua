-- Where the ground is uneven, it reaches down to it; here it is flat.
local Part = module("Part")
local parts =
  lsystem({ object = footprint({ { 0, 0 }, { 12, 0 }, { 12, 5 }, { 7, 5 }, { 7, 9 }, { 0, 9 } }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:groundwork("extruded", { color = "orange" }):walls({ height = 3 })
end)
parts:derive()
