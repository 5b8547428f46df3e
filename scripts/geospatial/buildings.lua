--!strict
-- Prismatic buildings from the polygon, the number of storeys and the kind of roof.
-- burgeon run scripts/geospatial/buildings.lua --data examples/data -o buildings.glb
local details = require("details")
local layers = require("layers")

local Building = module("Building", "geom", "floors", "roof")
local Volume = module("Volume", "geom", "height", "roof")
local Block, Gutter = module("Block", "geom", "height"), module("Gutter", "geom", "height")
local Roof, Terrace = module("Roof", "geom", "height", "roof"), module("Terrace", "geom", "height")
local Hips = module("Hips", "geom", "height")
local Sides, Top = module("Sides", "ring", "height", "points", "faces"), module("Top", "place")
local Pyramid = module("Pyramid", "ring", "x", "y", "height", "rise", "faces")

local storey = details.storey
local rise = param("rise", { default = 2.5, min = 0.5, max = 8, unit = "m", doc = "How high roofs are" })

-- Tests if a polygon is convex, so that it can have a pyramid roof.
local function is_convex(geom): boolean
  return geom:area() > 0.99 * geom:convex_hull():area()
end

local town = lsystem({ object = extruder({ smooth = false, roughness = 0.9 }) })
town:axiom(query(layers.buildings, Building))

town:rule("Building(geom, floors, roof)", {
  when = function(_, _, floors)
    return floors > 0
  end,
}, function(_, geom, floors, roof)
  return Volume(geom, floors * storey, roof)
end)
town:rule("Volume(geom, height, roof)", function(_, geom, height, roof)
  return { Block(geom, height) }, { Roof(geom, height, roof) }, { Gutter(geom, height) }
end)
town:rule("Roof(geom, height, roof)", {
  when = function(_, _, _, roof)
    return roof == 1
  end,
}, function(_, geom, height)
  return Terrace(geom, height)
end)
town:rule("Roof(geom, height, roof)", {
  when = function(_, geom, _, roof)
    return roof > 1 and is_convex(geom)
  end,
}, function(_, geom, height)
  local ring = geom:exterior_ring()
  local points = ring:num_points() - 1
  return Sides(ring, height, points, `{points},1,0`), Top(geom:centroid())
end)
-- Other roofs are hipped on all walls.
town:rule("Roof(geom, height, roof)", {
  when = function(_, _, _, roof)
    return roof > 1
  end,
}, function(_, geom, height)
  return Hips(geom, height)
end)
-- A triangle for each edge, from its two corners to the apex, which has the number 0.
town:rule("Sides(ring, height, points, faces)", {
  when = function(_, _, _, points)
    return points > 1
  end,
}, function(_, ring, height, points, faces)
  return Sides(ring, height, points - 1, `{points - 1},{points},0;{faces}`)
end)
town:rule("Sides(ring, height, points, faces) > Top(place)", {
  when = function(_, _, _, points)
    return points == 1
  end,
}, function(_, ring, height, _, faces, place)
  return Pyramid(ring, place:x(), place:y(), height, rise, faces)
end)

town:interpret("Block(geom, height)", function(this, geom, height)
  this:color("#d9cfbd"):polygon(geom):jump({ 0, 0, 0 }):extrude(height)
end)
town:interpret("Gutter(geom, height)", function(this, geom, height)
  this:color("#b8ad9a"):polygon(geom:buffer(0.3, { join = "mitre" }))
  this:jump({ 0, 0, height - 0.35 }):extrude(0.3)
end)
town:interpret("Terrace(geom, height)", function(this, geom, height)
  this:color("#8d8a84"):polygon(geom):jump({ 0, 0, height }):extrude(0.1)
  local parapet = geom:difference(geom:buffer(-0.35, { join = "mitre" }))
  for _, part in parapet:geometries() do
    this:color("#c9bfae"):polygon(part):jump({ 0, 0, height }):extrude(0.8)
  end
end)
town:interpret("Hips(geom, height)", function(this, geom, height)
  local highest = 0
  for _, ridge in geom:skeleton_faces() do
    for _, corner in ridge.rings[1] do
      highest = math.max(highest, corner[3])
    end
  end
  details.roof(this:color("#a2563d"), geom, height, rise / highest)
end)
town:interpret("Pyramid(ring, x, y, height, rise, faces)", function(this, ring, x, y, height, rise, faces)
  local points, sides = {}, {}
  for index, point in ring.points do
    points[index] = { point[1], point[2], height }
  end
  points[#points] = { x, y, height + rise }
  for a, b in string.gmatch(faces, "(%d+),(%d+),0") do
    table.insert(sides, { tonumber(a) :: number, tonumber(b) :: number, #points })
  end
  this:color("#a2563d"):jump({ 0, 0, 0 }):mesh(points, sides)
end)
town:interpret("Top(place)", function() end)
town:derive()
