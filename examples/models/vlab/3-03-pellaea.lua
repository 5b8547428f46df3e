--!strict
-- A fern frond: functions of the position on the axis give the distance of the leaflets, their angle and size, and
-- the bend of the axis. Leaflets on the left and on the right have sequences of their own.
-- Source: Virtual Laboratory (cpfg), inverse-modeling/03-pallaea, University of Calgary.
local length = param("length", { default = 2.25, min = 0.5, max = 3.1, unit = "m", doc = "Of the axis" })
local asymmetry =
  param("asymmetry", { default = 0.1, min = 0, max = 0.9, doc = "Difference between left and right" })
local BASE = 0.25 -- part of the axis without leaflets

-- By the part of the axis.
local distance = ramp({ { 0, 0.16 }, { 0.5, 0.14 }, { 0.85, 0.08 }, { 1, 0.04 } })
local angle = ramp({ { 0, 95 }, { 0.6, 75 }, { 1, 25 } })
local size = ramp({ { 0, 0.16 }, { 0.3, 0.34 }, { 0.7, 0.26 }, { 1, 0.08 } }, { kind = "spline" })
local bend = ramp({ { 0, 4 }, { 0.5, 20 }, { 1, 60 } }, { kind = "spline" })
local width = ramp({ { 0, 0.05 }, { 1, 0.012 } })

local Axis = module("Axis", "at", "left", "right")
local Leaflet, Segment = module("Leaflet", "at", "side"), module("Segment", "from", "to")

local blade = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-0.22, 0, 0.1), vec(0, 0.05, 0.1), vec(0.22, 0, 0.1) },
  { vec(-0.24, 0, 0.5), vec(0, 0.08, 0.5), vec(0.24, 0, 0.5) },
  { vec(0, 0.15, 1), vec(0, 0.15, 1), vec(0, 0.15, 1) },
}, { kind = "b-spline", degree = 2, divisions = 3 })

local frond = lsystem({ object = turtle({ color = "#6f7f3f", sides = 8 }), interpret = "last" })
-- Positions of the next leaflets on both sides.
frond:axiom(Segment(0, BASE * length), Axis(BASE * length, BASE * length, BASE * length + 0.05))
frond:decompose("Axis(at, left, right)", function(this, at: number, left: number, right: number): any
  local next_one, side = math.min(left, right), if left <= right then 1 else -1
  if next_one >= length then
    return Segment(at, length), Leaflet(length, 0)
  end
  local step = distance:at(next_one / length) * (1 + side * asymmetry)
  return Segment(at, next_one),
    { Leaflet(next_one, side) },
    Axis(next_one, if side == 1 then left + step else left, if side == 1 then right else right + step)
end)
frond:interpret("Segment(from, to)", function(this, from, to)
  local part = to / length
  -- The bend (degrees) is that of the whole axis, if it were the same everywhere.
  this:turn(bend:at(part) * (to - from) / length):width(width:at(part)):forward(to - from)
end)
frond:interpret("Leaflet(at, side)", function(this, at, side)
  local part = at / length
  this:roll(side * normal(10, 4)):turn(side * (angle:at(part) + normal(0, 4)))
  this:color("#4f8a45"):surface(blade, size:at(part) * normal(1, 0.05))
end)
local result = frond:derive(0)

-- The segments of the axis are its length.
local sum, left, right = 0, 0, 0
for from, to in string.gmatch(result.chains[1], "Segment%(([^,]+),([^)]+)%)") do
  sum += (tonumber(to) :: number) - (tonumber(from) :: number)
end
for side in string.gmatch(result.chains[1], "Leaflet%([^,]+,(%-?1)%)") do
  left += if side == "1" then 1 else 0
  right += if side == "-1" then 1 else 0
end
expect(sum, 2.25, 1e-9)
-- Distances on the left are longer than those on the right by a tenth each way.
expect(left < right, true)
expect(left / right, 0.9 / 1.1, 0.05)
-- Picture: --azimuth 180 --elevation 15
