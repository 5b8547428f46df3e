-- From upwards to the x direction.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 8 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:scale(0.12)
  for number = 0, 3 do
    local color = if number == 0 then "orange" else "#8a9aa8"
    this:color(color):jump({ 0, 0, 0 }):direction({ number, 0, 3 - number }):extrude(3)
  end
end)
parts:derive()
