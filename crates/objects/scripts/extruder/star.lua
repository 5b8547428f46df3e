-- Stars with 4, 5 and 6 points, and inner corners at 0.2, 0.5 and 0.8.
local Part = module("Part")
local parts = lsystem({ object = extruder({ smooth = false }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, inner in { 0.2, 0.5, 0.8 } do
    this:jump({ 2.6 * number, 0, 0 }):star(3 + number, inner):extrude(0.6)
  end
end)
parts:derive()
