-- Three turns of 30 degrees; the first segment is grey.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 8 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:scale(0.12):extrude(1)
  for number, color in { "#8a9aa8", "orange", "#7fa650" } do
    this:color(color):jump({ 0, 0, 1 }):turn(30):extrude(1.5)
  end
end)
parts:derive()
