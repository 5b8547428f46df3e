-- Two buildings of a list of plans, each a shape over its own footprint.
local Building = module("Building", "height")
local houses = lsystem({ object = footprint })
local plans = {
  { id = "a", geometry = polygon({ 0, 0 }, { 12, 0 }, { 12, 9 }, { 0, 9 }), height = 6 },
  { id = "b", geometry = polygon({ 16, 0 }, { 30, 2 }, { 27, 12 }, { 16, 10 }), height = 9 },
}
houses:axiom(source(plans), function(feature: any)
  return footprint(feature.geometry, { color = "#d5c6ab" }), Building(feature.height)
end)
houses:rule("Building(height)", function(this, height: number)
  local mass = this:plan():extrude(height)
  return Draw(mass), Draw(mass:faces("up")[1]:roof({ kind = "hip", height = 3 }):color("#8d4f3d"))
end)
houses:derive()
