-- A pyramid: each face is counter-clockwise, seen from outside.
local Part = module("Part")
local parts = lsystem({ object = turtle() })
parts:axiom(Part())
parts:interpret("Part", function(this)
  local points = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 0, 0, 1.5 } }
  local faces = { { 4, 3, 2, 1 }, { 1, 2, 5 }, { 2, 3, 5 }, { 3, 4, 5 }, { 4, 1, 5 } }
  this:mesh(points, faces, { colors = { "white", "orange", "#8a9aa8", "#7fa650", "#b0568a" } })
end)
parts:derive()
