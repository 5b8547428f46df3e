-- Groundwork down to the ground, which falls by 3 m.
local plan = { { 0, 0, 3 }, { 12, 0, 0 }, { 12, 5, 0.5 }, { 7, 5, 2 }, { 7, 9, 2.5 }, { 0, 9, 3 } }
local Part = module("Part")
local parts = lsystem({ object = footprint(plan) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:groundwork("extruded", { color = "orange" }):walls({ height = 3 }):roof({ kind = "flat" })
end)
parts:derive()
