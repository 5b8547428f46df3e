--!strict
-- Vases on a lathe: a function gives the radius at each height.
local Vase = module("Vase", "x", "height", "swell", "color")

local profile =
  ramp({ { 0, 0.24 }, { 0.08, 0.26 }, { 0.35, 0.5 }, { 0.72, 0.2 }, { 0.86, 0.16 }, { 1, 0.27 } })
local slim = ramp({ { 0, 0.2 }, { 0.1, 0.16 }, { 0.6, 0.34 }, { 0.85, 0.14 }, { 1, 0.2 } })

local vases = lsystem({ object = extruder({ sides = 64, roughness = 0.25 }) })
vases:axiom(
  { Vase(0, 1.5, 0, "#3f7f86") },
  { Vase(1.15, 1.1, 0.5, "#c9793f") },
  { Vase(2.1, 1.9, 1, "#e6dcc4") }
)

vases:interpret("Vase(x, height, swell, color)", function(this, x, height, swell, color)
  -- The profile between two functions.
  local radius = profile:mix(slim, swell)
  local pieces = 40
  this:jump({ x, 0, 0 }):color(color)
  for piece = 0, pieces - 1 do
    local from, to = piece / pieces, (piece + 1) / pieces
    this:scale(radius:at(from)):taper(radius:at(to)):extrude(height / pieces)
  end
  this:color("#2b2620"):scale(radius:at(1) * 0.88):extrude(0.004)
end)

vases:derive()
