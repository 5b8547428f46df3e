--!strict
-- Street furniture with directions from the data: benches that face away from their lawn.
-- burgeon run scripts/geospatial/furniture.lua --data examples/data -o furniture.glb
local layers = require("layers")
local models = require("models")
-- The ground and the lawns.
require("vegetation")

local Furniture = module("Furniture", "place", "code", "model", "direction")
local Standing = module("Standing", "place", "code", "model", "direction")

local street = lsystem({ object = extruder() })
street:axiom(query(layers.turned, Furniture))
street:rule("Furniture(place, code, model, direction)", function(_, place, code, model, direction)
  return Standing(place, code, model, direction)
end)
street:interpret("Standing(place, code, model, direction)", function(this, place, code, _, direction)
  models.stand(this, place, code, direction)
end)
street:derive()
