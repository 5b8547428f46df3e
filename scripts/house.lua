--!strict
-- Six plans on a slope with roofs of every kind: footprints with groundwork, walls, a straight skeleton, and chimneys.
local kinds = {
  "flat",
  "shed",
  "gable",
  "gambrel",
  "shed_gambrel",
  "hip",
  "mansard",
  "pagoda",
  "porch",
  "dutch_hip",
}
local kind = param("kind", {
  default = "all",
  choices = { "all", table.unpack(kinds) },
  doc = "Kind of all roofs, or one of each",
})
local eaves = param("eaves", {
  default = "open",
  choices = { "open", "closed", "slab" },
  doc = "How the roofs jut out",
})
local pitch = param("pitch", { default = 38, min = 5, max = 70, unit = "deg", doc = "Slope of the roofs" })
local floors = param("floors", { default = 2, min = 1, max = 6, step = 1, doc = "Storeys" })
local overhang =
  param("overhang", { default = 0.6, min = 0, max = 2, unit = "m", doc = "Width of the eaves" })
local furnished = param("furnished", { default = true, doc = "Whether chimneys and gutters are shown" })

-- The ground rises to the east.
local function rise(east: number): number
  return 0.06 * east
end

-- A ring is written as "x y, x y, ...".
local function ring(text: string, east: number, north: number)
  local points = {}
  for x, y in string.gmatch(text, "(%-?%d+)%s+(%-?%d+)") do
    local place = { tonumber(x) :: number, tonumber(y) :: number }
    table.insert(points, { east + place[1], north + place[2], rise(east + place[1]) })
  end
  return points
end

local plans = {
  { roof = "gable", color = "#e4d8c3", "0 0, 13 0, 13 8, 0 8" },
  { roof = "shed_gambrel", color = "#d8c3ae", "0 0, 15 0, 15 7, 7 7, 7 15, 0 15" },
  { roof = "mansard", color = "#e9e2d6", "0 0, 20 0, 20 17, 0 17", "6 6, 14 6, 14 11, 6 11" },
  { roof = "dutch_hip", color = "#d9c7a0", "0 8, 6 8, 6 0, 12 0, 12 8, 18 8, 18 15, 0 15" },
  { roof = "hip", color = "#e0d2c0", "0 0, 14 -2, 19 5, 13 8, 14 15, 3 13, 5 6" },
  {
    roof = "pagoda",
    color = "#cdbfae",
    "5 0, 11 0, 11 5, 16 5, 16 11, 11 11, 11 16, 5 16, 5 11, 0 11, 0 5, 5 5",
  },
}

local features = {}
for index, plan in plans do
  local east, north = (index - 1) % 3 * 25, math.floor((index - 1) / 3) * 24
  local rings = {}
  for _, text in ipairs(plan) do
    table.insert(rings, ring(text, east, north))
  end
  table.insert(features, { id = tostring(index), rings = rings, roof = plan.roof, color = plan.color })
end

-- The slope on which the houses stand, as a closed solid.
local Slope = module("Slope")
local land = lsystem({ object = extruder({ color = "#7f9160", roughness = 1 }) })
land:axiom(Slope())
land:interpret("Slope()", function(this)
  local west, east, south, north, base = -6, 75, -7, 45, -1
  this:mesh({
    { west, south, base },
    { east, south, base },
    { east, north, base },
    { west, north, base },
    { west, south, rise(west) },
    { east, south, rise(east) },
    { east, north, rise(east) },
    { west, north, rise(west) },
  }, {
    { 4, 3, 2, 1 },
    { 5, 6, 7, 8 },
    { 1, 2, 6, 5 },
    { 2, 3, 7, 6 },
    { 3, 4, 8, 7 },
    { 4, 1, 5, 8 },
  })
end)
land:derive()

-- Models on the roofs: a chimney of 0.6 m width, and a gutter of 1 m.
local Stack = module("Stack")
local masonry = lsystem({ object = extruder({ color = "#9a5b45", smooth = false }) })
masonry:axiom(Stack())
masonry:interpret("Stack()", function(this)
  this:rectangle(0.6, 0.8):extrude(2.2)
  this:rectangle(0.75, 0.95):extrude(0.15)
end)
local chimney = masonry:derive()

local Channel = module("Channel")
local tinwork = lsystem({ object = extruder({ color = "#8d9296", metallic = 1, roughness = 0.5 }) })
tinwork:axiom(Channel())
tinwork:interpret("Channel()", function(this)
  this:regular(8):jump({ -0.5, -0.06, 0.02 }):direction({ 1, 0, 0 }):scale(0.07):extrude(1)
end)
local gutter = tinwork:derive()

local House = module("House", "roof")
local Ground = module("Ground")
local Walls = module("Walls")
local Roof = module("Roof", "kind")

local houses = lsystem({ object = footprint })

houses:axiom(source(features), function(feature)
  local roof = if kind == "all" then feature.roof else kind
  return footprint(feature.rings, { color = feature.color, height = 2.9 }), House(roof)
end)

houses:rule("House(roof)", function(this, roof)
  local parts = { Ground() }
  for _ = 1, floors do
    table.insert(parts, Walls())
  end
  table.insert(parts, Roof(roof))
  return table.unpack(parts)
end)

houses:interpret("Ground()", function(this)
  this:groundwork("extruded", { color = "#7d7468", name = "plinth" })
end)
houses:interpret("Walls()", function(this)
  this:walls()
end)
houses:interpret("Roof(kind)", function(this, roof)
  local flat = roof == "flat"
  local stacks =
    { model = chimney, on = if flat then "slope" else "ridge", every = 4, margin = 1.5, count = 2, sink = 1 }
  local gutters = { model = gutter, on = "eaves", stretch = true }
  this:roof({
    kind = roof,
    slope = pitch,
    overhang = overhang,
    eaves = eaves,
    slab = if eaves == "closed" then 0 else 0.2,
    border = if flat then 0.6 else 0,
    material = { color = if flat then "#8f8f8b" else "#a3492f", roughness = 0.9, name = "tiles" },
    trim = { color = "#f1ece2", name = "trim" },
    details = if not furnished then {} elseif flat then { stacks } else { stacks, gutters },
  })
end)

houses:derive()
