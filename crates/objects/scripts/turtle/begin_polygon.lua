-- A polygon with five corners.
local Part = module("Part")
local parts = lsystem({ object = turtle({ color = "#7fa650", heading = { 0, 1, 0 } }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:begin_polygon()
  for _ = 1, 5 do
    this:point():advance(1):pitch(72)
  end
  this:end_polygon()
end)
parts:derive()
