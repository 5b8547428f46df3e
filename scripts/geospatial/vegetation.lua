--!strict
-- Lawns, flower beds, the trees of the data, and random trees on the grass between the flowers, one per 60 m2. Rules
-- query the chain itself: the grass is the lawn minus the beds, and no tree overlaps the crown of another.
-- burgeon run scripts/geospatial/vegetation.lua --data examples/data -o vegetation.glb
local layers = require("layers")
local models = require("models")
-- The ground.
require("pavements")

local Tree = module("Tree", "place", "species", "height", "radius")
local Garden = module("Garden", "geom")
local Lawn, Copse = module("Lawn", "geom"), module("Copse", "geom", "count", "tries")
local Grove, Bed = module("Grove", "geom"), module("Bed", "geom", "flowers")
local Planted = module("Planted", "place", "species", "height", "radius")

local LEVEL = 0.15
-- Maximum number of attempts for a tree; then the lawn gets no more trees.
local TRIES = 20

local green = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
green:axiom(query(layers.grass, Garden), query(layers.flowerbeds, Bed), query(layers.trees, Tree))

green:rule("Tree(place, species, height, radius)", {
  when = function(_, _, species)
    return species > 0
  end,
}, function(_, place, species, height, radius)
  return Planted(place, species, height, radius)
end)
green:rule("Garden(geom)", function(_, geom)
  local flowers = query("select ST_Union(geom) as geom from Bed where ST_Intersects(geom, $geom)")[1]
  local free = if flowers and flowers.geom then geom:difference(flowers.geom) else geom
  return Lawn(geom), Grove(free)
end)
green:rule("Grove(geom)", function(_, geom)
  return Copse(geom, math.round(geom:area() / 60), 0)
end)
green:rule("Copse(geom, count, tries)", {
  when = function(_, _, count, tries)
    return count > 0 and tries < TRIES
  end,
}, function(_, geom, count, tries)
  local place, radius = geom:random_point(random(), random()), random(2, 6)
  local near =
    "select 1 as near from Planted where ST_DWithin(place, $place, 0.7 * (radius + $radius)) limit 1"
  if #query(near, { place = place, radius = radius }) > 0 then
    return Copse(geom, count, tries + 1)
  end
  local tree = Tree(place, math.floor(random(1, 6)), random(2.2, 2.8) * radius, radius)
  return Copse(geom, count - 1, 0), tree
end)
green:rule("Copse", function()
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
green:interpret("Planted(place, species, height, radius)", function(this, place, species, height, radius)
  this
    :jump(place:place() + vec(0, 0, LEVEL))
    :place(models.trees[species], vec(2 * radius, 2 * radius, height))
end)
green:derive()
