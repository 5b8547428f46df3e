-- A row of bars with smoothly varying heights.
local Bar = module("Bar", "x")
local bars = lsystem({ object = extruder({ sides = 4 }) })
local chain = {}
for x = 1, 20 do
  chain[x] = { Bar(x) }
end
bars:axiom(sequence(chain))
bars:interpret("Bar(x)", function(this, x)
  this:jump({ x, 0, 0 }):scale(0.5):extrude(2 + noise(x / 5))
end)
bars:derive()
