--!strict
-- Lawns, flower beds, the trees that the data knows, and others that stand anywhere on the grass between the flowers:
-- one for every 60 m2.
-- burgeon run scripts/geospatial/vegetation.lua --data examples/data -o vegetation.glb
local layers = require("layers")
local models = require("models")
-- The ground on which all stands.
require("pavements")

local Tree = module("Tree", "place", "species", "height", "radius")
local Garden = module("Garden", "geom")
local Lawn, Planting = module("Lawn", "geom"), module("Planting", "geom", "count")
local Grove, Bed = module("Grove", "geom"), module("Bed", "geom", "flowers")
local Planted = module("Planted", "place", "species", "height", "radius")

local LEVEL = 0.15

local green = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
green:axiom(query(layers.grass, Garden), query(layers.flowerbeds, Bed), query(layers.trees, Tree))

green:rule("Tree(place, species, height, radius)", {
  when = function(_, _, species)
    return species > 0
  end,
}, function(_, place, species, height, radius)
  return Planted(place, species, height, radius)
end)
-- The grass is what the flowers leave.
green:rule("Garden(geom)", function(_, geom)
  local beds =
    `select ST_Union(geom) as geom from ({layers.flowerbeds}) as beds where ST_Intersects(geom, $geom)`
  local flowers = query(beds)[1]
  local free = if flowers and flowers.geom then geom:difference(flowers.geom) else geom
  return Lawn(geom), Grove(free)
end)
green:rule("Grove(geom)", function(_, geom)
  return Planting(geom, math.round(geom:area() / 60))
end)
green:rule("Planting(geom, count)", {
  when = function(_, _, count)
    return count > 0
  end,
}, function(_, geom, count)
  local place = geom:random_point(random(), random())
  return Planting(geom, count - 1), Tree(place, math.floor(random(1, 6)), random(5, 15), random(2, 6))
end)
green:rule("Planting", function()
  return nil
end)

green:interpret("Lawn(geom)", function(this, geom)
  this:material({ texture = "textures/grass.png", texture_size = { 4, 4 }, roughness = 1 })
  for _, part in geom:geometries() do
    this:polygon(part):jump({ 0, 0, LEVEL - 0.4 }):extrude(0.45)
  end
end)
green:interpret("Bed(geom, flowers)", function(this, geom, flowers)
  this:material({ texture = `textures/flowers{flowers}.png`, texture_size = { 2, 2 }, roughness = 1 })
  for _, part in geom:geometries() do
    this:polygon(part):jump({ 0, 0, LEVEL }):extrude(0.3)
  end
end)
green:interpret("Planted(place, species, height, radius)", function(this, place, species, height)
  this:jump(place:place() + vec(0, 0, LEVEL)):place(models.trees[species], height)
end)
green:derive()
