-- Ripeness from 0 to 1, mostly near 1, as the height of a column.
local Fruit = module("Fruit", "x")
local row = lsystem({ object = extruder({ sides = 16 }) })
row:axiom({ Fruit(0) }, { Fruit(2) }, { Fruit(4) }, { Fruit(6) })
row:interpret("Fruit(x)", function(this, x)
  local ripeness = beta(5, 2)
  this:jump({ x, 0, 0 }):scale(0.5 + 0.4 * ripeness):extrude(0.2 + 2 * ripeness)
end)
row:derive()
