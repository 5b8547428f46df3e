-- A row of towers: heights and twists come from two streams, so another number of heights changes no twist.
local Tower = module("Tower", "x")
local row = lsystem({ object = extruder({ sides = 5 }) })
row:axiom({ Tower(0) }, { Tower(3) }, { Tower(6) })
row:interpret("Tower(x)", function(this, x)
  local heights = stream("heights")
  this:jump({ x, 0, 0 })
  for storey = 1, 4 do
    local twist = stream("twist", storey)
    this:scale(twist(0.7, 1)):roll(twist(-20, 20)):extrude(heights(0.4, 0.9))
  end
end)
row:derive()
