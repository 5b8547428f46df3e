-- Colours 1 to 4 of the palette.
local Part = module("Part")
local parts =
  lsystem({ object = turtle({ width = 0.2, palette = { "#8a9aa8", "orange", "#7fa650", "#b0568a" } }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number = 1, 4 do
    this:paint(number):forward(0.5)
  end
end)
parts:derive()
