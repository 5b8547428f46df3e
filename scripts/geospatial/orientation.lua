--!strict
-- Street furniture without a direction faces the nearest road: bus stops and lamps face the street.
-- burgeon run scripts/geospatial/orientation.lua --data examples/data -o orientation.glb
local layers = require("layers")
local models = require("models")
-- The ground.
require("pavements")

local Piece = module("Piece", "place", "code")
local Item, End = module("Item", "place", "code"), module("End")
local Centreline, RoadSeg = module("Centreline", "geom"), module("RoadSeg", "geom")
local Road = module("Road", "geom", "distance")
local Turned = module("Turned", "place", "code", "direction")

local street = lsystem({ object = extruder() })
street:axiom(query(layers.furniture, Piece))

-- The centrelines nearby follow after the item, in segments.
street:rule("Piece(place, code)", function(_, place, code)
  return Item(place, code), query(layers.roads, Centreline), fragment(RoadSeg), End()
end)
-- Each segment compares its distance from the item with the next one, and the nearer segment stays.
street:rule("Item(place, code) < RoadSeg(geom)", function(_, place, _, geom)
  return Road(geom, place:distance(geom))
end)
street:rule("Item(place, code) Road(nearest, distance) < RoadSeg(geom)", function(_, place, _, _, _, geom)
  return Road(geom, place:distance(geom))
end)
street:rule("Road(a, nearest) < Road(b, distance)", {
  when = function(_, _, nearest, _, distance)
    return distance >= nearest
  end,
}, function()
  return nil
end)
street:rule("Road(a, distance) > Road(b, nearest)", {
  when = function(_, _, distance, _, nearest)
    return nearest < distance
  end,
}, function()
  return nil
end)
-- The remaining road decides.
street:rule("Item(place, code) > Road(geom, distance) End", function(_, place, code, geom)
  local toward = line(place:place(), geom:nearest_point(place):place()):direction()
  -- An item on the road itself faces across the road.
  return Turned(place, code, toward or (geom:direction() or 0) - 90)
end)
street:rule("Turned(place, code, direction) < Road(geom, distance)", function()
  return nil
end)
street:rule("Turned(place, code, direction) < End", function()
  return nil
end)

street:interpret("Turned(place, code, direction)", function(this, place, code, direction)
  models.stand(this, place, code, direction)
end)
street:derive()
