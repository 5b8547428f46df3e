-- A generalised cylinder through seven points, whose width changes smoothly.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.1, color = "#7fa650", sides = 16 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:begin_cylinder()
  for number = 1, 6 do
    this:width(if number % 2 == 0 then 0.1 else 0.3):forward(0.5):turn(30):pitch(-25)
  end
  this:end_cylinder()
end)
parts:derive()
