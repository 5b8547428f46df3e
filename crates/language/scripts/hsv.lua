-- Bars in all hues.
local Bar = module("Bar", "number")
local bars = lsystem({ object = extruder({ sides = 4 }) })
local chain = {}
for number = 1, 12 do
  chain[number] = { Bar(number) }
end
bars:axiom(sequence(chain))
bars:interpret("Bar(number)", function(this, number)
  this:jump({ number, 0, 0 }):color(hsv(number * 30, 0.7, 0.9)):scale(0.4):extrude(2)
end)
bars:derive()
