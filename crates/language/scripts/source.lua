-- A house for each feature of a list; a file source is source("town.gpkg:buildings").
local houses = source({
  { id = "inn", geometry = polygon({ 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 }), height = 6 },
  { id = "barn", geometry = polygon({ 14, 0 }, { 30, 0 }, { 30, 8 }, { 14, 8 }), height = 4 },
})
local House = module("House", "height")
local village = lsystem({ object = footprint })
village:axiom(houses, function(feature)
  return footprint(feature.geometry), House(feature.height)
end)
village:interpret("House(height)", function(this, height)
  this:walls({ height = height })
end)
village:derive()
