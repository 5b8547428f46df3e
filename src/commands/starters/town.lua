--!strict
-- Houses and a street from the data file town.geojson. Put your own data in its place: burgeon sources FILE lists the
-- layers and attributes of a file.
local roof_slope =
  param("slope", { default = 40, min = 10, max = 60, unit = "deg", doc = "Slope of the roofs" })

local houses = source("town.geojson", { where = "kind = 'house'" })
local lines = source("town.geojson", { where = "kind = 'street'" })
local trees = source("town.geojson", { where = "kind = 'tree'" })

-- One chain for each feature. `this` is the footprint of its house.
local House, Walls, Roof =
  module("House", "levels", "kind"), module("Walls", "levels"), module("Roof", "kind")
local town = lsystem({ object = footprint })
town:axiom(houses, function(feature)
  return footprint(feature.geometry, { color = feature.color }),
    House(feature.levels or 2, feature.roof or "gable")
end)
town:rule("House(levels, kind)", function(this, levels, kind)
  return Walls(levels), Roof(kind)
end)
town:interpret("Walls(levels)", function(this, levels)
  this:walls({ height = 3 * levels })
end)
town:interpret("Roof(kind)", function(this, kind)
  this:roof({ kind = kind, slope = roof_slope, overhang = 0.3, color = "#8c4a3a" })
end)
town:derive()

-- The street, with kerbs and markings.
local Start = module("Start")
local roads =
  lsystem({ object = network({ existing = { { lines = lines, width = "width" } }, square_ends = true }) })
roads:axiom(Start())
roads:derive(0)

-- A tree for each point.
local Tree = module("Tree", "place", "height")
local avenue = lsystem({ object = turtle({ width = 0.3, color = "#6b5138" }) })
avenue:axiom(trees, function(feature)
  return Tree(feature.geometry:place(), feature.height)
end)
avenue:interpret("Tree(place, height)", function(this, place, height)
  this:jump(place):forward(height * 0.6):color("#64913f"):sphere(height * 0.3)
end)
avenue:derive()
