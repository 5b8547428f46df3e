-- A colour by name, and as { red, green, blue }.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 8 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, color in { "#8a9aa8", "orange", "seagreen", { 0.7, 0.2, 0.4 } } do
    this:jump({ 2.2 * number, 0, 0 }):color(color):extrude(1.6)
  end
end)
parts:derive()
