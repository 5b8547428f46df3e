--!strict
-- A town's streets and nothing else, by one of the patterns of templates/roads.lua. Rules say where streets want to go;
-- the network says what becomes of them, and keeps their distances, angles and corners.
local roads = require("templates/roads")

local pattern = param("pattern", {
  default = "organic",
  choices = { "organic", "raster", "radial", "contours", "population", "districts", "centres" },
})
local extent = param("extent", { default = 600, min = 150, max = 5000, unit = "m", text = "From the middle" })
local dead_ends = param("dead_ends", { default = "keep", choices = { "keep", "remove" } })

-- Hills, for streets that go around them.
local hills = math.floor(random() * 1000000)
local function height(x: number, y: number): number
  return 60 * noise(x / 500, y / 500, 0.5, hills)
end

-- People, who live around a middle and two villages.
local function people(x: number, y: number): number
  local function near(east: number, north: number, reach: number): number
    return math.exp(-((x - east) ^ 2 + (y - north) ^ 2) / (2 * reach * reach))
  end
  return near(0, 0, extent * 0.3)
    + 0.7 * near(extent * 0.6, extent * 0.35, extent * 0.16)
    + 0.6 * near(-extent * 0.3, -extent * 0.65, extent * 0.16)
end

local ways: { [string]: () -> any } = {
  organic = function()
    return { pattern = roads.organic() }
  end,
  raster = function()
    return { pattern = roads.raster({ angle = 12 }), headings = { 12, 102, 192, 282 }, join = 140 }
  end,
  radial = function()
    return { pattern = roads.radial(), headings = { 0, 60, 120, 180, 240, 300 } }
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
options.network = { ground = "#66774e" }
options.steps = math.ceil(extent / 25)
roads.grow(options)
