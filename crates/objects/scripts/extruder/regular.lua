-- Prisms with 3, 4, 6 and 24 sides.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, sides in { 3, 4, 6, 24 } do
    this:jump({ 2.6 * number, 0, 0 }):regular(sides):extrude(1)
  end
end)
parts:derive()
