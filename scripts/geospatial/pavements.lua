--!strict
-- Pavements from a layer of polygons, levelled and paved by code: carriageways, slabs, crossings, cobbles.
-- burgeon run scripts/geospatial/pavements.lua --data examples/data -o pavements.glb
local layers = require("layers")

local Pavement = module("Pavement", "geom", "code", "level")
local Counting = module("Counting", "geom", "code", "level", "length", "points", "corners")
local Laid = module("Laid", "geom", "code", "level", "length", "corners")

local ASPHALT, SLABS, CROSSING, COBBLES = 1, 2, 3, 4
local PAVING = {
  [ASPHALT] = { texture = "textures/asphalt.png", texture_size = { 2, 2 }, roughness = 1 },
  [SLABS] = { texture = "textures/slabs.png", texture_size = { 2, 2 }, roughness = 1 },
  [CROSSING] = { texture = "textures/asphalt.png", texture_size = { 2, 2 }, roughness = 1 },
  [COBBLES] = { texture = "textures/cobbles.png", texture_size = { 1.6, 1.6 }, roughness = 1 },
}
local DEPTH = 0.4
-- Polygons with more corners are divided.
local MOST_CORNERS = 1000

local streets = lsystem({ object = extruder({ smooth = false }) })
streets:axiom(query(layers.pavements, Pavement))

-- Areas of several parts are paved part by part.
streets:rule("Pavement(geom, code, level)", {
  when = function(_, geom)
    return geom:num_geometries() > 1
  end,
}, function(_, geom, code, level)
  local parts = {}
  for _, part in geom:geometries() do
    table.insert(parts, Pavement(part, code, level))
  end
  return table.unpack(parts)
end)
-- The ground of a whole town is one polygon around all of its streets.
streets:rule("Pavement(geom, code, level)", {
  when = function(_, geom)
    return geom:num_points() > MOST_CORNERS
  end,
}, function(_, geom, code, level)
  local ring = geom:envelope():exterior_ring()
  local low, high = ring:point_n(1):place(), ring:point_n(3):place()
  local is_wide = high.x - low.x > high.y - low.y
  local east = if is_wide then (low.x + high.x) / 2 else high.x
  local north = if is_wide then high.y else (low.y + high.y) / 2
  local half = polygon({ { low.x, low.y }, { east, low.y }, { east, north }, { low.x, north } })
  return Pavement(geom:intersection(half), code, level), Pavement(geom:difference(half), code, level)
end)
-- The texture follows the longer side of the enclosing rectangle. Each step counts one corner of the rectangle.
streets:rule("Pavement(geom, code, level)", function(_, geom, code, level)
  local length = math.max(geom:envelope_width(), geom:envelope_height())
  return Counting(geom, code, level, length, geom:exterior_ring():num_points() - 1, "-1")
end)
streets:rule("Counting(geom, code, level, length, points, corners)", {
  when = function(_, _, _, _, _, points)
    return points > 0
  end,
}, function(_, geom, code, level, length, points, corners)
  return Counting(geom, code, level, length, points - 1, `{points - 1},{corners}`)
end)
streets:rule(
  "Counting(geom, code, level, length, points, corners)",
  function(_, geom, code, level, length, _, corners)
    return Laid(geom, code, level, length, corners)
  end
)

-- The bars of a crossing run along the street, next to each other across the street.
local function bars(this, geom, level: number)
  local sides = geom:oriented_envelope():segments()
  local across, along = sides[1], sides[2]
  if across:length() < along:length() then
    across, along = along, across
  end
  local from, to = across:start_point():place(), across:end_point():place()
  local reach = along:end_point():place() - along:start_point():place()
  if
    (along:start_point():place() - from):length() < 0.01
    or (along:start_point():place() - to):length() < 0.01
  then
    -- The path points away from the side that the rule visits.
  else
    reach = reach * -1
  end
  local count = math.floor(across:length())
  for bar = 0, count - 1 do
    local a, b = from:lerp(to, (bar + 0.25) / count), from:lerp(to, (bar + 0.75) / count)
    this:polygon({ a, b, b + reach, a + reach }):jump({ 0, 0, level }):extrude(0.012)
  end
end

streets:interpret("Laid(geom, code, level, length, corners)", function(this, geom, code, level)
  this:material(PAVING[code] or PAVING[SLABS])
  this:polygon(geom):jump({ 0, 0, level - DEPTH }):extrude(DEPTH)
  if code == CROSSING then
    bars(this:material({ color = "#e6e4dc", roughness = 1 }), geom, level)
  end
end)
streets:derive()
