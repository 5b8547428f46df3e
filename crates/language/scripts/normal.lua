-- A row of trunks: the thickness of each varies around 0.5 m.
local Trunk = module("Trunk", "x")
local row = lsystem({ object = extruder({ sides = 12 }) })
row:axiom({ Trunk(0) }, { Trunk(2) }, { Trunk(4) }, { Trunk(6) })
row:interpret("Trunk(x)", function(this, x)
  local radius = math.max(0.1, normal(0.25, 0.08))
  this:jump({ x, 0, 0 }):scale(radius):extrude(normal(3, 0.4))
end)
row:derive()
