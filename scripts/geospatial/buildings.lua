--!strict
-- Prismatic buildings from nothing but their polygon, the number of floors and the kind of roof.
-- burgeon run scripts/geospatial/buildings.lua --data examples/data -o buildings.glb
local Building = module("Building", "geom", "floors", "roof")
local Volume = module("Volume", "ring", "height", "roof")
local Block, Gutter = module("Block", "ring", "height"), module("Gutter", "ring", "height")
local Roof, Terrace = module("Roof", "ring", "height", "roof"), module("Terrace", "ring", "height")
local Sides, Top = module("Sides", "ring", "height", "points", "faces"), module("Top", "place")
local Pyramid = module("Pyramid", "ring", "x", "y", "height", "rise", "faces")

source("quarter/buildings.geojson")

local storey = param("storey", { default = 3, min = 2.4, max = 5, unit = "m", text = "How high a floor is" })
local rise = param("rise", { default = 2.5, min = 0.5, max = 8, unit = "m", text = "How high roofs are" })

local town = lsystem({ object = extruder({ smooth = false, roughness = 0.9 }) })
town:axiom(query("select geom, floors, roof from buildings", Building))

town:rule("Building(geom, floors, roof)", {
  when = function(_, _, floors)
    return floors > 0
  end,
}, function(_, geom, floors, roof)
  return Volume(geom:exterior_ring(), floors * storey, roof)
end)
town:rule("Volume(ring, height, roof)", function(_, ring, height, roof)
  return { Block(ring, height) }, { Roof(ring, height, roof) }, { Gutter(ring, height) }
end)
town:rule("Roof(ring, height, roof)", {
  when = function(_, _, _, roof)
    return roof == 1
  end,
}, function(_, ring, height)
  return Terrace(ring, height)
end)
town:rule("Roof(ring, height, roof)", {
  when = function(_, _, _, roof)
    return roof > 1
  end,
}, function(_, ring, height)
  local points = ring:num_points() - 1
  return Sides(ring, height, points, `{points},1,0`), Top(ring:centroid())
end)
-- A triangle for each edge, from its two corners to the top, which has the number 0.
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

town:interpret("Block(ring, height)", function(this, ring, height)
  this:color("#d9cfbd"):polygon(ring):jump({ 0, 0, 0 }):extrude(height)
end)
town:interpret("Gutter(ring, height)", function(this, ring, height)
  this:color("#b8ad9a"):polygon(polygon(ring.points):buffer(0.3, { join = "mitre" }))
  this:jump({ 0, 0, height - 0.35 }):extrude(0.3)
end)
town:interpret("Terrace(ring, height)", function(this, ring, height)
  local floor = polygon(ring.points)
  this:color("#8d8a84"):polygon(floor):jump({ 0, 0, height }):extrude(0.1)
  local parapet = floor:difference(floor:buffer(-0.35, { join = "mitre" }))
  for _, part in parapet:geometries() do
    this:color("#c9bfae"):polygon(part):jump({ 0, 0, height }):extrude(0.8)
  end
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
