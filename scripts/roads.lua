--!strict
-- The street network of a town, by one of the patterns of templates/roads.lua. Rules propose streets; the network
-- decides about them, and keeps distances, angles and corners.
local roads = require("templates/roads")

local pattern = param("pattern", {
  default = "organic",
  choices = { "organic", "raster", "radial", "contours", "population", "districts", "centres" },
})
local extent = param("extent", { default = 1000, min = 150, max = 5000, unit = "m", doc = "From the middle" })
local dead_ends = param("dead_ends", { default = "keep", choices = { "keep", "remove" } })

-- Hills for the contour pattern.
local hills = math.floor(random() * 1000000)
local function height(x: number, y: number): number
  return 60 * noise(x / 500, y / 500, 0.5, hills)
end

-- The population around a centre and two villages.
local function people(x: number, y: number): number
  local function near(east: number, north: number, reach: number): number
    return math.exp(-((x - east) ^ 2 + (y - north) ^ 2) / (2 * reach * reach))
  end
  return near(0, 0, extent * 0.3)
    + 0.7 * near(extent * 0.6, extent * 0.35, extent * 0.16)
    + 0.6 * near(-extent * 0.3, -extent * 0.65, extent * 0.16)
end

-- A small town has small blocks and one quarter.
local small = math.clamp(0.5 + extent / 1200, 0.6, 1)
local variety = math.min(1, extent / 600)

local ways: { [string]: () -> any } = {
  organic = function()
    return { pattern = roads.organic({ block = small * random(62, 74), variety = variety }) }
  end,
  raster = function()
    local angle = random(0, 90)
    return {
      pattern = roads.raster({
        angle = angle,
        block = small * random(105, 150),
        width = small * random(65, 85),
        variety = variety,
      }),
      headings = { angle, angle + 90, angle + 180, angle + 270 },
    }
  end,
  radial = function()
    local rays, turned, headings = math.floor(random(5, 9)), random(0, 90), {}
    for ray = 1, rays do
      table.insert(headings, turned + ray * 360 / rays)
    end
    return {
      pattern = roads.radial({ block = small * random(75, 110), variety = variety }),
      headings = headings,
    }
  end,
  contours = function()
    return { pattern = roads.contours(height) }
  end,
  population = function()
    return { pattern = roads.populous(people), population = people }
  end,
  districts = function()
    local old = { at = { 0, 0 }, pattern = roads.organic({ block = 60 }) }
    local new = { at = { extent * 0.8, 0 }, pattern = roads.raster({ angle = 20 }) }
    local west = { at = { -extent * 0.7, extent * 0.5 }, pattern = roads.raster({ angle = -30, block = 90 }) }
    local garden = {
      at = { -extent * 0.3, -extent * 0.8 },
      pattern = roads.radial({ middle = { -extent * 0.3, -extent * 0.7 } }),
    }
    return { pattern = roads.districts({ old, new, west, garden }) }
  end,
  centres = function()
    local far = extent * 0.62
    return { centres = { { 0, 0 }, { far, far * 0.3 }, { -far * 0.5, far * 0.8 }, { -far * 0.3, -far } } }
  end,
}

local options = ways[pattern]()
options.extent = extent
options.dead_ends = dead_ends
options.network = {
  -- Larger streets are darker.
  streets = {
    { name = "main street", width = 24, lanes = 4, sidewalk = 4, asphalt = "#43474d" },
    { name = "street", width = 16, lanes = 2, parking = 2.2, sidewalk = 3, asphalt = "#5b6067" },
    { name = "lane", width = 11, lanes = 2, sidewalk = 2, asphalt = "#757a81" },
  },
  paving = "#d3cfc6",
  block_color = "#a9b58c",
}
options.steps = math.ceil(extent / 25) + 8
if pattern == "organic" then
  -- Old courts and alleys are narrow.
  local alley = { name = "alley", width = 5, lanes = 1, sidewalk = 0.7, asphalt = "#8a8f95" }
  table.insert(options.network.streets, alley)
  options.network.clearance, options.network.corner = 3.75, 2.5
end
roads.grow(options)
