-- An L-shaped cross-section with a hole.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  local outer = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }
  local hole = { { 0.3, 0.3 }, { 0.7, 0.3 }, { 0.7, 1.5 }, { 0.3, 1.5 } }
  this:polygon(outer, { hole }):extrude(0.8)
end)
parts:derive()
