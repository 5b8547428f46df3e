--!strict
-- A street from data: each feature of a file is a house, a tree or the street itself.
local lush = param("lush", { default = 1, min = 0.3, max = 1.6, doc = "Size of the trees" })

-- The features of street.geojson, which stands next to this script.
local houses = source("street.geojson", { where = "kind = 'house'" })
local trees = source("street.geojson", { where = "kind = 'tree'" })
local lines = source("street.geojson", { where = "kind = 'street'" })

-- The street with its sidewalks, and a lawn under everything.
local Start = module("Start")
local roads = lsystem({
  object = network({
    existing = { { lines = lines, width = "width" } },
    streets = { { lanes = 2, sidewalk = 3, parking = 0 } },
    square_ends = true,
  }),
})
roads:axiom(Start())
roads:derive(0)

local Lawn = module("Lawn", "shape")
local ground = lsystem({ object = extruder({ smooth = false, color = "#8a9a5b" }) })
ground:axiom(Lawn(lines.features[1].geometry:buffer(24, { cap = "flat" })))
ground:interpret("Lawn(shape)", function(this, shape)
  this:jump({ 0, 0, -0.6 }):polygon(shape):extrude(0.55)
end)
ground:derive(0)

-- Storeys with windows. The side of the street has a door, or a shop window.
local function framed(width: { number }, height: number, color: string): Wall
  local face =
    panel({ material = { color = color, roughness = 0.1 }, width = width, height = { height, height } })
  return extruded(face, { depth = -0.18 })
end
local window = bordered(framed({ 0.8, 1, 1.2 }, 1.6, "#3a4850"), {
  left = 0.45,
  right = 0.45,
  bottom = { 0.8, "fixed" },
  top = 0.4,
})
local storey = grid(window, { rows = 1, height = { 2.8, 3, 3.2 } })
local door = bordered(framed({ 1.1, 1.1 }, 2.3, "#5b3b2c"), { left = 0.5, right = 0.5, top = 0.4 })
local shop = bordered(
  framed({ 1.8, 2.4, 3.4 }, 2.3, "#46626b"),
  { left = 0.35, right = 0.35, bottom = { 0.3, "fixed" }, top = 0.4 }
)
local function front(walls: { Wall }): Wall
  return list({ list(walls, { height = { 2.8, 3.4 } }), grid(storey) }, { direction = "vertical" })
end
-- The templates in the colour of each house.
local facades: { [string]: Facade } = {}
for _, house in houses do
  local material = { color = house.color }
  facades[house.color] = facade({
    template({ wall = grid(storey), material = material }),
    template({
      wall = front({ door, grid(window, { rows = 1 }) }),
      keywords = { "entry door" },
      material = material,
    }),
    template({
      wall = front({ door, grid(shop, { rows = 1 }) }),
      keywords = { "entry door", "shop" },
      material = material,
    }),
    template({ wall = panel({}), keywords = { "blind" }, material = material }),
  })
end

-- One chain for each house. `this` is its own footprint.
local House, Walls, Roof =
  module("House", "levels", "kind", "color"), module("Walls", "levels", "color"), module("Roof", "kind")
local row = lsystem({ object = footprint })
local ways = streets(lines)
row:axiom(houses, function(feature)
  local keywords = if feature.shop then { "shop" } else {}
  return footprint(feature.geometry, {
    color = feature.color,
    height = 3 * feature.levels,
    keywords = keywords,
    streets = ways,
  }),
    House(feature.levels, feature.roof, feature.color)
end)
row:rule("House(levels, kind, color)", function(this, levels, kind, color)
  return Walls(levels, color), Roof(kind)
end)
row:interpret("Walls(levels, color)", function(this, levels, color)
  this
    :groundwork("extruded", { color = "#8d8a83" })
    :walls({ height = 3 * levels, templates = facades[color] })
end)
row:interpret("Roof(kind)", function(this, kind)
  this:roof({
    kind = kind,
    slope = if kind == "mansard" then 50 else 40,
    height = if kind == "mansard" then 3.6 else nil,
    overhang = 0.35,
    slab = 0.15,
    material = { color = choose({ "#8f4a38", "#7a4034", "#5b5f66" }) },
    trim = { color = "#e9e4d8" },
  })
end)
row:derive()

-- A tree for each point: a trunk and a crown of spheres.
local Tree = module("Tree", "place", "height")
local avenue = lsystem({ object = turtle({ sides = 8 }) })
avenue:axiom(trees, function(feature: any)
  return Tree(feature.geometry:place(), feature.height * lush)
end)
avenue:interpret("Tree(place, height)", function(this, place, height)
  this:jump(place):color("#6b5138"):width(0.28):forward(height * 0.45)
  this:color(choose({ "#5f8a3c", "#6d9645", "#577f38" }))
  for number = 1, 5 do
    local turn = math.rad(72 * number + random(0, 30))
    local away = height * 0.15
    local up = height * random(0.5, 0.72)
    this:jump(place + vec(away * math.cos(turn), away * math.sin(turn), up)):sphere(height * 0.2)
  end
  this:jump(place + vec(0, 0, height * 0.8)):sphere(height * 0.2)
end)
avenue:derive()
