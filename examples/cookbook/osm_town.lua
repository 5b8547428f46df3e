--!strict
-- A village from OpenStreetMap: layers of one file become houses, streets, water, a park and trees.
local slope = param("slope", { default = 42, min = 10, max = 60, unit = "deg", doc = "Slope of the roofs" })

-- An extract of any place works: village.osm is an invented one. Layers are named behind the colon.
local buildings, lanes = source("village.osm:buildings"), source("village.osm:roads")

-- The ground, with water and parks as thin plates on it.
local Plate = module("Plate", "shape", "from", "to", "color")
local ground = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
local low, high = buildings.bounds.min, buildings.bounds.max
local middle = point((low[1] + high[1]) / 2, (low[2] + high[2]) / 2)
local plates = { Plate(middle:buffer(185), -4, -0.05, "#8c9a5f") }
for _, area in source("village.osm:water") do
  table.insert(plates, Plate(area.geometry, -0.05, 0.02, "#5c8a96"))
end
for _, area in source("village.osm:green") do
  table.insert(plates, Plate(area.geometry, -0.05, 0.06, "#6f9148"))
end
ground:axiom(sequence(plates))
ground:interpret("Plate(shape, from, to, color)", function(this, shape, from, to, color)
  this:jump({ 0, 0, from }):color(color):polygon(shape):extrude(to - from)
end)
ground:derive(0)

-- Streets with their true widths, junctions and kerbs.
local Start = module("Start")
local roads = lsystem({
  object = network({
    existing = { { lines = lanes, width = "width" } },
    streets = { { sidewalk = 1 } },
    markings = false,
  }),
})
roads:axiom(Start())
roads:derive(0)

-- Buildings: tags have usual values where the map has none.
local ROOFS: { [string]: string } =
  { gabled = "gable", hipped = "hip", pyramidal = "hip", ["half-hipped"] = "dutch_hip" }
local Walls, Roof = module("Walls", "height", "color"), module("Roof", "kind", "color", "slope")
local village = lsystem({ object = footprint })
village:axiom(buildings, function(feature: any)
  local height = feature.height or 2.9 * (feature.levels or 2)
  local kind = ROOFS[feature.roof_shape or "gabled"] or "flat"
  return footprint(feature.geometry),
    Walls(height, feature.colour or "#e2d6c0"),
    Roof(kind, feature.roof_colour or "#8f4c3b", if feature.roof_shape == "pyramidal" then 70 else slope)
end)
village:interpret("Walls(height, color)", function(this, height, color)
  this:walls({ height = height, color = color })
end)
village:interpret("Roof(kind, color, slope)", function(this, kind, color, slope)
  this:roof({ kind = kind, slope = slope, overhang = 0.4, color = color })
end)
village:derive()

local Tree = module("Tree", "place", "height")
local trees = lsystem({ object = turtle({ sides = 6, width = 0.25 }) })
trees:axiom(source("village.osm:trees"), function(feature)
  return Tree(feature.geometry:place(), feature.height or 8)
end)
trees:interpret("Tree(place, height)", function(this, place, height)
  this
    :jump(place)
    :forward(height * 0.5)
    :color(choose({ "#5f8a3d", "#74994a", "#547d3c" }))
    :sphere(height * 0.26)
  this:forward(height * 0.22):sphere(height * 0.2)
end)
trees:derive()
