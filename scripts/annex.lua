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

if #existing == 0 then
  error(
    `annex: {file} has no lines that are streets, so there is nothing to grow onto: name a layer of streets, FILE:LAYER`
  )
end

-- What is not connected to the town, on which a district would lie by itself, is left out: streets are connected where their
-- lines have a point in common.
local part: { [number]: number } = {}
local function whole(street: number): number
  while part[street] ~= street do
    part[street] = part[part[street]]
    street = part[street]
  end
  return street
end
local seen: { [string]: number }, lengths: { [number]: number } = {}, {}
for number, street in existing do
  part[number] = number
  for _, point in street.lines[1].points do
    local at = `{math.round(point[1] * 10)} {math.round(point[2] * 10)}`
    if seen[at] then
      part[whole(number)] = whole(seen[at])
    end
    seen[at] = number
  end
end
local most = 1
for number, street in existing do
  local of = whole(number)
  lengths[of] = (lengths[of] or 0) + street.lines[1]:length()
end
for of, length in lengths do
  if length > (lengths[most] or 0) then
    most = of
  end
end
-- What ends near them is joined to them when it is laid.
local SNAP = 14
local connected, apart = {}, {}
for number, street in existing do
  table.insert(if whole(number) == most then connected else apart, street)
end
repeat
  local before, rest = #apart, {}
  for _, street in apart do
    local is_near = false
    for _, other in connected do
      is_near = is_near or street.lines[1]:distance(other.lines[1]) < SNAP * 0.7
      if is_near then
        break
      end
    end
    table.insert(if is_near then connected else rest, street)
  end
  apart = rest
until #apart == before
if #apart > 0 then
  print(`annex: left out {#apart} of {#existing} streets, which are not connected to the others`)
end

local low, high = town.bounds.min, town.bounds.max
local middle = { (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 }
-- Streets of a district do not end before it is full, and none leaves around a green.
local patterns: { [string]: () -> any } = {
  organic = function()
    return roads.organic({
      block = 75,
      bends = 30,
      branching = 1,
      cross = 0.3,
      stop = 0,
      gap = 0,
      greens = 0,
      variety = 0.4,
    })
  end,
  raster = roads.raster,
  radial = function()
    return roads.radial({ middle = middle })
  end,
}
roads.grow({
  pattern = patterns[pattern](),
  network = {
    streets = { { width = 17, sidewalk = 3 }, { width = 12, sidewalk = 2.4 }, { width = 9, sidewalk = 1.7 } },
    existing = connected,
    starts = {},
    min_angle = 35,
    snap = SNAP,
    ground = "#66774e",
  },
  onto = true,
  deepest = 8,
  join = 110,
  detour = 2,
  extent = function(x: number, y: number): boolean
    return x > low[1] - reach and x < high[1] + reach and y > low[2] - reach and y < high[2] + reach
  end,
  steps = math.ceil(reach / 25) + 6,
})
