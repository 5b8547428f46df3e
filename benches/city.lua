--!strict
-- The 17,362 buildings of a real city, with simple or with detailed facades.
local rich = param("rich", { default = false, doc = "whether every bay is a model" })
local expand = param("expand", { default = false, doc = "whether models become faces" })

local function plain(color)
  return { color = color, roughness = 0.9 }
end

-- Simple templates: a base, the storeys above it, and sometimes a cornice.
local function simple(color, base)
  return template({
    wall = list({
      panel({ height = { 2, 3, 4 }, material = plain(base) }),
      panel({ material = plain(color) }),
    }, { direction = "vertical" }),
    material = plain(color),
  })
end
local simple_facade = facade({
  simple("#d9cdb8", "#9c9284"),
  simple("#cdb79b", "#8a7d6c"),
  template({ wall = panel({}), material = plain("#c9c4b8") }),
})

-- A detailed template: every bay is a model of a window, its frame, its reveal and the wall around it.
local Box = module("Box", "x", "z", "width", "height", "depth")
local bay = lsystem({ object = extruder({ smooth = false, color = "#e6dcc8" }) })
bay:axiom(
  Box(-2.1, 0, 1.4, 3.2, 0.3),
  Box(0.7, 0, 1.4, 3.2, 0.3),
  Box(-0.7, 0, 1.4, 0.9, 0.3),
  Box(-0.7, 2.6, 1.4, 0.6, 0.3)
)
bay:interpret("Box(x, z, width, height, depth)", function(this, x, z, width, height, depth)
  this:jump({ x, 0, z }):polygon({ { 0, 0 }, { width, 0 }, { width, depth }, { 0, depth } }):extrude(height)
end)
local window = panel({
  model = bay:derive(),
  stretch = true,
  background = false,
  width = { 0.5, 5.4, 12 },
  height = { 1, 3.4, 4.8 },
})
local rich_facade = facade({ template({ wall = grid(window), material = plain("#e6dcc8") }) })

local templates = if rich then rich_facade else simple_facade
local roofs = { "hip", "gable", "flat" }
local House = module("House", "height", "roof")

local function city(buildings)
  local houses = lsystem({ object = footprint, interpret = "last" })
  houses:axiom(buildings, function(feature)
    return footprint(feature.geometry), House(math.max(feature.height or 6, 3), roofs[random() * 3 // 1 + 1])
  end)
  houses:interpret("House(height, roof)", function(this, height, roof)
    this:groundwork("z_min")
    this:walls({ height = height, templates = templates, expand = expand })
    this:roof({ kind = roof, slope = 30, color = "#a4583f" })
  end)
  houses:derive()
end

city(source("france_buildings.gpkg:buildings"))
city(source("france_buildings.gpkg:buildings", { limit = 1754 }))
