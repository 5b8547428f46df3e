--!strict
-- A leaf as a swept surface: an open section moves along a curve, and a function of its length scales the section.
-- Source: L-Py, tutorial/01 - turtle/07 - sweepsurface, F. Boudon and C. Godin.
local leaves = param("leaves", { default = 7, min = 1, max = 12, step = 1, doc = "Leaves of the rosette" })
local width = param("width", { default = 0.5, min = 0.1, max = 1.5, doc = "Scale of the section" })
local ROWS = 24 -- along the leaf

local path = curve({
  points = { { -0.5, 0 }, { -0.192641, 0.281385 }, { 0.0238095, -0.177489 }, { 0.5, 0 } },
  kind = "bezier",
})
local section = curve({
  points = {
    { -0.508658, 0.112554 },
    { -0.162338, -0.155844 },
    { -0.0238095, 0.158009 },
    { 0.192641, -0.177489 },
    { 0.582251, 0.168831 },
  },
  kind = "b-spline",
})
local profile = ramp(
  { { 0, 0.0137255 }, { 0.320346, 0.341991 }, { 0.649351, 0.121212 }, { 1, 0 } },
  { kind = "spline" }
)

-- The x axis of the path is the heading z of the leaf, and its y axis is up.
local rows: { { Vector } } = {}
for j = 0, ROWS do
  local t = j / ROWS
  local place, tangent = path:point(t) - path:point(0), path:tangent(t)
  local scale = width * profile:at(t)
  rows[j + 1] = {}
  for i = 0, 12 do
    local point = section:point(i / 12) * scale
    rows[j + 1][i + 1] = vec(point.x, -place.y - point.y * tangent.x, place.x - point.y * tangent.y)
  end
end
local leaf = surface({ points = rows, kind = "b-spline", divisions = 2 })

local Leaf = module("Leaf")
local rosette = lsystem({ object = turtle({ color = "#4f8f4a" }) })
local whorl: { any } = {}
for _ = 1, leaves do
  table.insert(whorl, { Pitch(40), G(0.05), Leaf() })
  table.insert(whorl, Roll(360 / leaves))
end
rosette:axiom(sequence(whorl))
rosette:interpret("Leaf", function(this)
  this:surface(leaf)
end)
local result = rosette:derive(0)

-- The scale at the end is 0: all points of the last row are the end of the path, 1 m away.
expect(leaf:point(0.3, 1):distance(vec(0, 0, 1)), 0, 1e-9)
expect(result.counts.Leaf, 7)
-- Picture: --azimuth 160 --elevation 35
