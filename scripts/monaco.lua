--!strict
-- Buildings on hills: footprints with heights on measured terrain; rules add detail between its samples.
-- burgeon run scripts/monaco.lua --data FOLDER -o monaco.png, with monaco.gpkg and N43E007.hgt.zip in that folder
local file = param("buildings", { default = "monaco.gpkg:buildings", doc = "The buildings: FILE:LAYER" })
local heights = param("elevation", { default = "N43E007.hgt.zip", doc = "The heights of the ground" })
local size = param(
  "size",
  { default = 4800, min = 500, max = 20000, unit = "m", doc = "Length of a side of the ground" }
)
local levels =
  param("levels", { default = 9, min = 4, max = 11, step = 1, doc = "How often the ground is divided" })

local buildings = source(file)
local low, high = buildings.bounds.min, buildings.bounds.max
local middle = { (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 }

local land = lsystem({
  object = terrain({
    size = size,
    position = middle,
    levels = levels,
    elevation = elevation(heights, { fill = true }),
    rules = {
      Rock = {
        "Rock",
        "Scree",
        "Scree",
        "Rock",
        change = { { -1, 1 }, { -1, 1 }, { -1, 1 }, { -1, 1 } },
        decay = 0.55,
      },
      Scree = {
        "Scree",
        "Rock",
        "Scree",
        "Scree",
        change = { { -0.7, 0.7 }, { -0.7, 0.7 }, { -0.7, 0.7 }, { -0.7, 0.7 } },
        decay = 0.5,
      },
    },
    decay = 12,
    error = 0.25,
    covers = {
      { color = "#7d7f58" },
      { color = "#5c6b40", on = { noise = 0.8, scale = 300 } },
      { color = "#4c5a38", on = { noise = 0.6, scale = 70, slope = { 4, 18 } } },
      { color = "#a39a86", on = { slope = { 24, 40 }, noise = 0.35, scale = 90 } },
      { color = "#b5ab93", on = { height = { 6, 2 } } },
    },
    water = { level = 0.4, clarity = 14 },
    base = -60,
  }),
})
local ground = land:derive().objects[1]

-- If the data has neither height nor storeys: wide buildings near the harbour are towers, small ones on the slopes
-- are houses.
local function guess(feature): number
  local wide = feature.building == "apartments" or feature.building == "hotel"
  return if wide then 9 else 5
end

local House = module("House", "height")
local walls = { "#e9d8bd", "#e6c9a0", "#e3b996", "#f0e6d3", "#dccfbd", "#e8d2b8", "#d9b48f" }
local houses = lsystem({ object = footprint })
houses:axiom(buildings, function(feature)
  return footprint(feature.geometry, { ground = ground }),
    House(tonumber(feature.height) or 3.2 * (tonumber(feature.levels) or guess(feature)))
end)
houses:interpret("House(height)", function(this, height)
  local color = walls[math.floor(random(1, #walls + 0.999))]
  this:groundwork("extruded", { color = "#b3a58c" }):walls({ height = height, color = color })
  if this:area() < 600 and height < 25 then
    this:roof({ kind = "hip", slope = 22, color = "#b4623f", overhang = 0.3 })
  else
    this:roof({ kind = "flat", color = "#b9b1a6" })
  end
end)
houses:derive()
