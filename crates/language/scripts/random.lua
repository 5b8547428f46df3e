-- A row of stones, each of another size: the number belongs to the module that draws it.
local Stone = module("Stone", "x")
local row = lsystem({ object = extruder({ sides = 6 }) })
row:axiom({ Stone(0) }, { Stone(2) }, { Stone(4) })
row:interpret("Stone(x)", function(this, x)
  this:jump({ x, 0, 0 }):scale(random(0.4, 0.9)):extrude(0.5 + random())
end)
row:derive()
