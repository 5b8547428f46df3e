--!strict
-- A gear wheel, translated from OpenSCAD: shapes are combined in the plane, then extruded.
local teeth = param("teeth", { default = 24, min = 8, max = 60, step = 1, doc = "Number of teeth" })
local radius =
  param("radius", { default = 1, min = 0.5, max = 3, unit = "m", doc = "Radius without the teeth" })

local Gear = module("Gear", "x", "teeth", "radius", "turn")

-- The solid is `difference() { union() { circle; teeth } circle; holes }` in the plane.
local function section(teeth: number, radius: number): Geometry
  local shape = point(0, 0):buffer(radius)
  for number = 0, teeth - 1 do
    local angle = math.rad(number * 360 / teeth)
    local out, side = vec(math.cos(angle), math.sin(angle), 0), vec(-math.sin(angle), math.cos(angle), 0)
    local root, tip = out * (radius - 0.02), out * (radius + 0.16)
    shape =
      shape:union(polygon(root - side * 0.09, tip - side * 0.045, tip + side * 0.045, root + side * 0.09))
  end
  for number = 0, 5 do
    local angle = math.rad(number * 60)
    shape = shape:difference(
      point(0.62 * radius * math.cos(angle), 0.62 * radius * math.sin(angle)):buffer(0.2 * radius)
    )
  end
  return shape:difference(point(0, 0):buffer(0.16 * radius))
end

local gears = lsystem({ object = extruder({ color = "#b8863b", roughness = 0.35 }) })
gears:axiom(
  { Gear(0, teeth, radius, 0) },
  { Gear(1.6 * radius + 0.16, teeth // 2 + teeth // 12, 0.6 * radius, 7) }
)
gears:interpret("Gear(x, teeth, radius, turn)", function(this, x, teeth, radius, turn)
  this:jump({ x, 0, 0 }):roll(turn):polygon(section(teeth, radius)):extrude(0.25)
end)
gears:derive()
