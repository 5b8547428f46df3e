--!strict
-- Leaves of a lily: four functions of the length give width, bend, turn and twist, and a leaf is the surface of a contour
-- that moves along its axis.
-- Source: Virtual Laboratory (cpfg), inverse-modeling/01-herb-lily, University of Calgary.
local leaves = param("leaves", { default = 9, min = 1, max = 20, step = 1, doc = "Leaves of the plant" })
local twisting = param("twisting", { default = 1, min = -3, max = 3, doc = "Strength of the twist" })
local STEPS = 40 -- along the axis

-- By the part of the length: half of the width (m), and curvatures (degrees in the whole length).
local width = ramp({ { 0, 0.03 }, { 0.25, 0.05 }, { 0.6, 0.075 }, { 0.85, 0.045 }, { 1, 0 } })
local bend = ramp({ { 0, 10 }, { 0.4, 60 }, { 0.8, 190 }, { 1, 60 } }, { kind = "spline" })
local turn = ramp({ { 0, 0 }, { 0.5, 30 }, { 1, -60 } }, { kind = "spline" })
local twist = ramp({ { 0, 0 }, { 0.5, 80 }, { 1, 200 } }, { kind = "spline" })
-- Half of the contour: the height of the sides above the rib, by the part of the half width.
local keel = ramp({ { 0, 0 }, { 0.5, 0.12 }, { 1, 0.45 } })

-- A vector, turned about an axis of length 1 by an angle (degrees).
local function turned(v: Vector, axis: Vector, angle: number): Vector
  local c, s = math.cos(math.rad(angle)), math.sin(math.rad(angle))
  return v * c + axis:cross(v) * s + axis * (axis:dot(v) * (1 - c))
end

-- The points of the axis are one step apart, so a leaf is 1 m long.
local function leaf_of(variation: number): (Surface, number)
  local place, heading, left = vec(0, 0, 0), vec(0, 0, 1), vec(-1, 0, 0)
  local rows: { { Vector } }, length = {}, 0
  for k = 0, STEPS do
    local t = k / STEPS
    local up = heading:cross(left)
    rows[k + 1] = {}
    for i = -2, 2 do
      local side, sign = math.abs(i) / 2, if i < 0 then 1 else -1
      local half = width:at(t)
      rows[k + 1][i + 3] = place + left * (sign * half * side) + up * (half * keel:at(side))
    end
    if k < STEPS then
      place += heading / STEPS
      length += 1 / STEPS
      local about_up = turned(heading, up, variation * turn:at(t) / STEPS)
      left = turned(left, up, variation * turn:at(t) / STEPS)
      heading = turned(about_up, left, bend:at(t) / STEPS):unit()
      left = turned(left, heading, twisting * variation * twist:at(t) / STEPS):unit()
    end
  end
  return surface({ points = rows, kind = "b-spline", divisions = 1 }), length
end

local Leaf = module("Leaf", "number")
local plant = lsystem({ object = turtle({ color = "#4f8a45" }) })
local whorl: { any } = {}
for number = 1, leaves do
  table.insert(whorl, Roll(137.5))
  table.insert(whorl, { Pitch(8 + 24 * number / leaves), Leaf(number) })
end
plant:axiom(sequence(whorl))
plant:interpret("Leaf(number)", function(this, number)
  local leaf = leaf_of(if number % 2 == 0 then 1 else -1)
  this:surface(leaf, 0.75 + 0.25 * (leaves - number) / leaves)
end)
local result = plant:derive(0)

local leaf, length = leaf_of(1)
expect(length, 1, 1e-9)
-- The width is 0 at the tip, where all points of the contour are one.
expect(leaf:point(0, 1):distance(leaf:point(1, 1)), 0, 1e-9)
expect(result.counts.Leaf, 9)
-- Picture: --azimuth 200 --elevation 15
