-- A row of stones of random sizes: each module has its own random numbers.
local Stone = module("Stone", "x")
local row = lsystem({ object = extruder({ sides = 6 }) })
row:axiom({ Stone(0) }, { Stone(2) }, { Stone(4) })
row:interpret("Stone(x)", function(this, x)
  this:jump({ x, 0, 0 }):scale(random(0.4, 0.9)):extrude(0.5 + random())
end)
row:derive()
