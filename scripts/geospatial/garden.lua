--!strict
-- A garden laid out from its boundary: circular lawns, eight paths that meet in the centre, flower beds with a tree
-- on every large lawn, and trees on the grass.
-- burgeon run scripts/geospatial/garden.lua --data examples/data -o garden.glb
local layers = require("layers")
local models = require("models")

local way = param("way", { default = 4, min = 1, max = 8, unit = "m", doc = "Half the width of the ways" })

local Area, Plan = module("Area", "geom"), module("Plan", "geom", "radius")
local Circle = module("Circle", "geom")
local Ways, Border = module("Ways", "geom", "x", "y"), module("Border", "line", "x", "y")
local Side, Gate = module("Side", "line", "x", "y"), module("Gate", "place", "x", "y")
local Crossway, Radial = module("Crossway", "geom"), module("Radial", "geom")
local Garden, FlowerCandidate = module("Garden", "geom"), module("FlowerCandidate", "geom")
local Bed, ParkTree = module("Bed", "geom", "flowers"), module("ParkTree", "place", "species", "height")
local Lawn, Grass = module("Lawn", "geom"), module("Grass", "geom")
local Planting = module("Planting", "geom", "count")

local park = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
park:axiom(query(layers.parks, Area))

park:rule("Area(geom)", function(_, geom)
  return Plan(geom, math.sqrt(geom:area() / (2 * math.pi)))
end)
park:rule("Plan(geom, radius)", function(_, geom, radius)
  local middle = geom:centroid()
  return Lawn(geom),
    Circle(geom:difference(middle:buffer(radius))),
    Circle(middle:buffer(radius - 8):difference(middle:buffer(radius / 2)):intersection(geom)),
    Ways(geom:oriented_envelope(), middle:x(), middle:y()),
    Garden(middle:buffer(radius / 4):intersection(geom))
end)

-- A path from the centre to each corner of the enclosing rectangle, and to the centre of each side.
park:rule("Ways(geom, x, y)", function(_, geom, x, y)
  return Border(geom:exterior_ring(), x, y), fragment(Side)
end)
park:rule("Side(line, x, y)", function(_, line, x, y)
  return Gate(line:start_point(), x, y), Gate(line:centroid(), x, y)
end)
park:rule("Gate(place, x, y)", function(_, place, x, y)
  return Crossway(line(place:place(), { x, y }):buffer(way))
end)

-- Unite the paths, from last to first, and subtract them from the circles.
park:rule("Crossway(geom) > Garden(_)", function(_, geom)
  return Radial(geom)
end)
park:rule("Crossway(geom) > Radial(others)", function(_, geom, others)
  return Radial(geom:union(others))
end)
park:rule("Circle(geom) > Radial(ways)", function(_, geom, ways)
  local made = { Radial(ways) }
  for _, lawn in geom:difference(ways):geometries() do
    table.insert(made, Garden(lawn))
    table.insert(made, FlowerCandidate(lawn))
  end
  return table.unpack(made)
end)

park:rule("FlowerCandidate(geom)", {
  when = function(_, geom)
    return geom:area() > 500
  end,
}, function(_, geom)
  local middle = geom:centroid()
  if not geom:contains(middle) then
    middle = geom:point_on_surface()
  end
  local bed = middle:buffer(8):intersection(geom:inset(1.5))
  return Bed(bed, math.floor(random(1, 5))), ParkTree(middle, 6, random(15, 20))
end)
park:rule("FlowerCandidate", function()
  return nil
end)
park:rule("Radial(a) < Radial(b)", function()
  return nil
end)
-- After the layout, the grass between the beds gets a tree per 200 m2.
park:rule("Garden(geom) > Bed(bed, _)", function(_, geom, bed)
  return Grass(geom), Planting(geom:difference(bed:buffer(3)), math.round(geom:area() / 200))
end)
park:rule("Planting(geom, count)", {
  when = function(_, _, count)
    return count > 0
  end,
}, function(_, geom, count)
  local place = geom:random_point(random(), random())
  return Planting(geom, count - 1), ParkTree(place, math.floor(random(1, 6)), random(5, 11))
end)

local function level(this, geom, from: number, to: number)
  for _, part in geom:geometries() do
    this:polygon(part):jump({ 0, 0, from }):extrude(to - from)
  end
end

park:interpret("Lawn(geom)", function(this, geom)
  level(this:color("#c9b894"), geom, -0.4, 0.05)
end)
local function grass(this, geom)
  this:material({ texture = "textures/grass.png", texture_size = { 4, 4 }, roughness = 1 })
  level(this, geom, 0, 0.2)
end
park:interpret("Garden(geom)", grass)
park:interpret("Grass(geom)", grass)
park:interpret("Bed(geom, flowers)", function(this, geom, flowers)
  this:material({ texture = `textures/flowers{flowers}.png`, texture_size = { 2, 2 }, roughness = 1 })
  level(this, geom, 0.2, 0.5)
end)
park:interpret("ParkTree(place, species, height)", function(this, place, species, height)
  this:jump(place:place() + vec(0, 0, 0.2)):place(models.trees[species], height)
end)
park:interpret("Radial(geom)", function() end)
park:interpret("Planting(geom, count)", function() end)
park:derive()
