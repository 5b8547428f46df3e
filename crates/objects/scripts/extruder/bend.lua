-- Bends of 90 degrees: toward 0 is grey, 90 orange, 180 green, 270 purple. The extruder faces up, and its own up is along x.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 8 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, color in { "#8a9aa8", "orange", "#7fa650", "#b0568a" } do
    local toward = 90 * (number - 1)
    this:color(color):jump({ 0, 0, 0 }):direction({ 0, 0, 1 }, { -1, 0, 0 }):scale(0.12)
    this:bend(0):extrude(1):bend(90, toward):extrude(1.6)
  end
end)
parts:derive()
