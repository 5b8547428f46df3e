--!strict
-- Six plans under roofs of every kind: footprints with groundwork, walls and a straight skeleton above.
local kind = param("kind", {
  default = "all",
  choices = { "all", "flat", "shed", "hip", "mansard", "pagoda", "porch", "gable", "gambrel" },
  text = "Kind of all roofs, or one of each",
})
local pitch = param("pitch", { default = 38, min = 5, max = 70, unit = "deg", text = "Slope of the roofs" })
local floors = param("floors", { default = 2, min = 1, max = 6, step = 1, text = "Storeys" })
local overhang =
  param("overhang", { default = 0.6, min = 0, max = 2, unit = "m", text = "Width of the eaves" })

local House = module("House", "roof")
local Ground = module("Ground")
local Walls = module("Walls", "height", "color")
local Roof = module("Roof", "kind")

local rectangle = { { 0, 0 }, { 13, 0 }, { 13, 8 }, { 0, 8 } }
local l = { { 0, 0 }, { 15, 0 }, { 15, 7 }, { 7, 7 }, { 7, 15 }, { 0, 15 } }
local t = { { 0, 8 }, { 5.5, 8 }, { 5.5, 0 }, { 11.5, 0 }, { 11.5, 8 }, { 17, 8 }, { 17, 15 }, { 0, 15 } }
local cross = {
  { 5, 0 },
  { 11, 0 },
  { 11, 5 },
  { 16, 5 },
  { 16, 11 },
  { 11, 11 },
  { 11, 16 },
  { 5, 16 },
  { 5, 11 },
  { 0, 11 },
  { 0, 5 },
  { 5, 5 },
}
local block = { { 0, 0 }, { 14, -2 }, { 19, 5 }, { 13, 8 }, { 14, 15 }, { 3, 13 }, { 5, 6 } }
local court = { { 0, 0 }, { 20, 0 }, { 20, 17 }, { 0, 17 } }
local yard = { { 6, 6 }, { 14, 6 }, { 14, 11 }, { 6, 11 } }

-- The plans in a row of three and a row of three behind it.
local plans = { { rectangle }, { l }, { court, yard }, { t }, { block }, { cross } }
local roofs = { "gable", "hip", "mansard", "gambrel", "porch", "pagoda" }
local colors = { "#e4d8c3", "#d8c3ae", "#e9e2d6", "#d9c7a0", "#e0d2c0", "#cdbfae" }
local features = {}
for index, rings in plans do
  local x, y = (index - 1) % 3 * 25, math.floor((index - 1) / 3) * 24
  local moved = {}
  for _, ring in rings do
    local points = {}
    for _, point in ring do
      table.insert(points, { point[1] + x, point[2] + y, 0.06 * point[1] })
    end
    table.insert(moved, points)
  end
  table.insert(features, { id = tostring(index), rings = moved, roof = roofs[index], color = colors[index] })
end

local houses = lsystem({ object = footprint })

houses:axiom(source(features), function(feature)
  local roof = if kind == "all" then feature.roof else kind
  return footprint(feature.rings, { color = feature.color }), House(roof)
end)

houses:rule("House(roof)", function(this, roof)
  local parts = { Ground() }
  for _ = 1, floors do
    table.insert(parts, Walls(2.9, false))
  end
  table.insert(parts, Roof(roof))
  return table.unpack(parts)
end)

houses:interpret("Ground()", function(this)
  this:groundwork("extruded", { color = "#7d7468", name = "plinth" })
end)
houses:interpret("Walls(height, color)", function(this, height)
  this:walls({ height = height })
end)
houses:interpret("Roof(kind)", function(this, roof)
  this:roof({
    kind = roof,
    slope = pitch,
    overhang = overhang,
    slab = 0.2,
    border = if roof == "flat" then 0.6 else 0,
    material = { color = if roof == "flat" then "#8f8f8b" else "#a3492f", roughness = 0.9, name = "tiles" },
    gable = { color = "#e4d8c3", name = "gable" },
    trim = { color = "#f1ece2", name = "trim" },
  })
end)

houses:derive()
