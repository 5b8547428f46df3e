--!strict
-- A new district that grows onto the streets of a real town: from the open ends of what is there, outwards.
-- burgeon run scripts/annex.lua --data examples/data -o annex.svg
local roads = require("templates/roads")

local file =
  param("file", { default = "quarter/roads.geojson", text = "The streets; for a layer of it, FILE:LAYER" })
local reach = param(
  "reach",
  { default = 250, min = 20, max = 3000, unit = "m", text = "How far the district goes beyond them" }
)
local pattern = param("pattern", { default = "organic", choices = { "organic", "raster", "radial" } })

-- How often the way to a street has branched off, by what it is called; what people only walk on is left out.
local DEPTH: { [string]: number } =
  { motorway = 0, trunk = 0, primary = 0, secondary = 0, tertiary = 1, main = 0, unclassified = 1 }
local LEFT_OUT =
  { footway = true, path = true, steps = true, cycleway = true, pedestrian = true, service = true }

local town = source(file)
local existing = {}
for _, feature in town do
  local kind = feature.highway or feature.kind or ""
  if feature.geometry.kind == "line" and not LEFT_OUT[kind] then
    table.insert(existing, {
      lines = { feature.geometry },
      depth = DEPTH[kind] or 2,
      bridge = feature.bridge ~= nil and feature.bridge ~= false and feature.bridge ~= "no",
    })
  end
end

local low, high = town.bounds.min, town.bounds.max
local middle = { (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 }
roads.grow({
  pattern = if pattern == "radial" then roads.radial({ middle = middle }) else (roads :: any)[pattern](),
  network = {
    streets = { { width = 17, sidewalk = 3 }, { width = 12, sidewalk = 2.4 }, { width = 9, sidewalk = 1.7 } },
    existing = existing,
    starts = {},
    min_angle = 35,
    snap = 14,
    ground = "#66774e",
  },
  onto = true,
  extent = function(x: number, y: number): boolean
    return x > low[1] - reach and x < high[1] + reach and y > low[2] - reach and y < high[2] + reach
  end,
  steps = math.ceil(reach / 25) + 6,
})
