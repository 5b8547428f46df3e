-- 1, 3 and 12 pieces along, and 4, 12 and 48 points around.
local Part = module("Part")
local parts = lsystem({ object = extruder() })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:smooth(false):bend(90)
  for number, pieces in { 1, 3, 12 } do
    this:direction({ 0, 0, 1 }):jump({ 1.6 * number, 0, 0 })
    this:scale(0.45):resolution(pieces, 4 * pieces):extrude(2)
  end
end)
parts:derive()
