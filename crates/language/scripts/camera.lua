-- A row of poles, seen by a person who stands beside it.
camera({ name = "street", from = { 3, -6, 1.7 }, to = { 0, 20, 2 }, fov = 55 })
camera({ name = "side", azimuth = 110, elevation = 12 })
camera({ name = "first poles", azimuth = 150, elevation = 20, to = { 0, 8, 2 }, radius = 6 })
camera({ name = "map", view = "plan" })
local Pole = module("Pole", "y")
local poles = lsystem({ object = extruder() })
local chain = {}
for number = 1, 10 do
  chain[number] = Pole(number * 4)
end
poles:axiom(sequence(chain))
poles:interpret("Pole(y)", function(this, y)
  this:jump({ 0, y, 0 }):scale(0.2):extrude(4)
end)
poles:derive()
