-- A contour with four lobes blends into a circle.
local lobes = curve({
  points = {
    { 1, 0 },
    { 0.4, 0.4 },
    { 0, 1 },
    { -0.4, 0.4 },
    { -1, 0 },
    { -0.4, -0.4 },
    { 0, -1 },
    { 0.4, -0.4 },
  },
  closed = true,
})
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 1, color = "#b0568a", sides = 32 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:contour(lobes):begin_cylinder():forward(1):pitch(20):forward(1)
  this:contour():width(0.5):pitch(20):forward(1):end_cylinder()
end)
parts:derive()
