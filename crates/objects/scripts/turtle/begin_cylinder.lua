-- A generalised cylinder whose width changes smoothly, and a square bar that twists by 40 degrees from point to point.
local square =
  curve({ points = { { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } }, closed = true, kind = "linear" })
local Part, Bar = module("Part"), module("Bar")
local parts = lsystem({ object = turtle({ width = 0.1, color = "#7fa650", sides = 16 }) })
parts:axiom({ Part() }, { Bar() })
parts:interpret("Part", function(this)
  this:begin_cylinder()
  for number = 1, 6 do
    this:width(if number % 2 == 0 then 0.1 else 0.3):forward(0.5):turn(30):pitch(-25)
  end
  this:end_cylinder()
end)
parts:interpret("Bar", function(this)
  this:jump({ 0.9, 0, 0 }):color("#5b6f8f"):width(0.4):contour(square):begin_cylinder({ twist = true })
  for _ = 1, 4 do
    this:roll(40):forward(0.4)
  end
  this:end_cylinder()
end)
parts:derive()
