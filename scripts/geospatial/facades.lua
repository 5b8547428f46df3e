--!strict
-- Windows and balconies on walls without another building within 3 m, and blank walls next to neighbours.
-- burgeon run scripts/geospatial/facades.lua --data examples/data -o facades.glb
local details = require("details")
local layers = require("layers")

local Building = module("Building", "geom", "id", "floors", "style")
local Outline = module("Outline", "line", "id", "floors", "style")
local Wall = module("Wall", "line", "id", "floors", "style")
local Candidate, Zone = module("Candidate", "line", "id", "floors", "style"), module("Zone", "geom", "id")
local Facade, Volume =
  module("Facade", "line", "floors", "style"), module("Volume", "geom", "floors", "style")

local town = lsystem({ object = extruder({ smooth = false, roughness = 0.9 }) })
town:axiom(query(layers.buildings, Building))

town:rule("Building(geom, id, floors, style)", function(_, geom, id, floors, style)
  return Volume(geom, floors, style), Outline(geom:exterior_ring(), id, floors, style), fragment(Wall)
end)
town:rule("Wall(line, id, floors, style)", function(_, line, id, floors, style)
  -- Neighbours in the same row touch a wall at its ends, and do not cover it.
  local zone = line:line_substring(0.15, 0.85):buffer(3, { cap = "flat" })
  return Candidate(line, id, floors, style), Zone(zone, id)
end)
town:rule("Candidate(line, id, floors, style) > Zone(geom, other)", {
  when = function(_, _, _, _, _, geom)
    return #query(layers.neighbors, { geom = geom }) == 0
  end,
}, function(_, line, _, floors, style)
  return Facade(line, floors, style)
end)
town:rule("Candidate", function()
  return nil
end)
town:rule("Zone", function()
  return nil
end)

town:interpret("Volume(geom, floors, style)", details.volume)
town:interpret("Facade(line, floors, style)", details.facade)
town:derive()
