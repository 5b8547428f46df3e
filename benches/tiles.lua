--!strict
-- Houses with simple facades and random roofs, for tiles.
local function plain(color)
  return { color = color, roughness = 0.9 }
end

local function simple(color, base)
  return template({
    wall = list({
      panel({ height = { 2, 3, 4 }, material = plain(base) }),
      panel({ material = plain(color) }),
    }, { direction = "vertical" }),
    material = plain(color),
  })
end
local templates = facade({
  simple("#d9cdb8", "#9c9284"),
  simple("#cdb79b", "#8a7d6c"),
  template({ wall = panel({}), material = plain("#c9c4b8") }),
})
local roofs = { "hip", "gable", "flat" }
local House = module("House", "height", "roof")

local houses = lsystem({ object = footprint, interpret = "last" })
houses:axiom(source("city.gpkg:buildings"), function(feature)
  return footprint(feature.geometry), House(3 * feature.levels, roofs[random() * 3 // 1 + 1])
end)
houses:interpret("House(height, roof)", function(this, height, roof)
  this:walls({ height = height, templates = templates })
  this:roof({ kind = roof, slope = 30, color = "#a4583f" })
end)
houses:derive(1)
