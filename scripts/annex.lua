--!strict
-- A new district that grows from the open ends of the streets of a real town, around existing buildings, with its own
-- houses and gardens.
-- burgeon run scripts/annex.lua --data examples/data -o annex.glb
local build = require("templates/build")
local nature = require("templates/nature")
local quarters = require("templates/quarters")
local roads = require("templates/roads")

local file =
  param("file", { default = "quarter/roads.geojson", doc = "The streets; for a layer of it, FILE:LAYER" })
local standing = param("standing", {
  default = "quarter/buildings.geojson",
  doc = "The buildings there, FILE:LAYER; nothing if none are known",
})
local reach = param(
  "reach",
  { default = 250, min = 20, max = 3000, unit = "m", doc = "How far the district goes beyond them" }
)
local pattern = param("pattern", { default = "organic", choices = { "organic", "raster", "radial" } })

-- Hierarchy level by type of street. Footpaths are omitted.
local DEPTH: { [string]: number } =
  { motorway = 0, trunk = 0, primary = 0, secondary = 0, tertiary = 1, main = 0, unclassified = 1 }
local LEFT_OUT =
  { footway = true, path = true, steps = true, cycleway = true, pedestrian = true, service = true }

local town = source(file)
local existing, ways = {}, {}
for _, feature in town do
  local kind = feature.highway or feature.kind or ""
  if feature.geometry.kind == "line" and not LEFT_OUT[kind] then
    -- The attributes of a street identify bridges and tunnels.
    table.insert(existing, { lines = feature, depth = DEPTH[kind] or 2 })
    table.insert(ways, feature.geometry)
  end
end

if #existing == 0 then
  error(
    `annex: {file} has no lines that are streets, so there is nothing to grow onto: name a layer of streets, FILE:LAYER`
  )
end

local low, high = town.bounds.min, town.bounds.max
local function box(around: number): any
  return polygon({
    { low[1] - around, low[2] - around },
    { high[1] + around, low[2] - around },
    { high[1] + around, high[2] + around },
    { low[1] - around, high[2] + around },
  })
end

-- The union of the geometries of a list, by halves.
local function united(list: { any }, first: number, last: number): any
  if first >= last then
    return list[first]
  end
  local half = (first + last) // 2
  return united(list, first, half):union(united(list, half + 1, last))
end

-- The nearby buildings. New streets avoid them. Buildings that already overlap a street are ignored.
local known: { any }, covered: { any }, obstacles: { any } = {}, {}, {}
if standing ~= "" then
  local near, all = box(reach), united(ways, 1, #ways)
  for _, building in source(standing) do
    if building.geometry:area() > 0 and building.geometry:intersects(near) then
      table.insert(known, building)
      table.insert(covered, building.geometry:buffer(0.5))
      if not building.geometry:buffer(10):intersects(all) then
        table.insert(obstacles, building.geometry)
      end
    end
  end
  if #known == 0 then
    print(
      `annex: no building of {standing} is near the streets of {file}: set standing to a file of the same town`
    )
  end
end
local old = united(covered, 1, #covered)
local function is_free(geometry: any): boolean
  return not old or not geometry:intersects(old)
end

local middle = { (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 }
-- Streets of a district do not end before it is full, and no street starts at a green.
local patterns: { [string]: () -> any } = {
  organic = function()
    return roads.organic({
      block = 60,
      bends = 30,
      branching = 1,
      cross = 0.5,
      stop = 0,
      gap = 0,
      greens = 0,
      variety = 0.3,
    })
  end,
  raster = function()
    return roads.raster({ gap = 0, variety = 0.4 })
  end,
  radial = function()
    return roads.radial({ middle = middle, gap = 0, variety = 0.4 })
  end,
}
local streets = roads.grow({
  pattern = patterns[pattern](),
  network = {
    streets = {
      { width = 17, sidewalk = 3, trees = 11 },
      { width = 12, sidewalk = 2.4 },
      { width = 9, sidewalk = 1.7 },
    },
    existing = existing,
    starts = {},
    min_angle = 35,
    snap = 14,
    obstacles = obstacles,
  },
  onto = true,
  deepest = 8,
  join = 110,
  detour = 2,
  extent = function(x: number, y: number): boolean
    return x > low[1] - reach and x < high[1] + reach and y > low[2] - reach and y < high[2] + reach
  end,
  steps = math.ceil(reach / 3) + 20,
}).objects[1] :: Network

-- Lots along streets without buildings: rows of adjoining houses, with gardens behind them.
local STYLES = { "terrace_house", "porto", "terrace_house", "porto", "haussmann", "villa" }
local houses: { any }, gardens: { any } = {}, {}
local function house(id: string, geometry: any, style: string, levels: number)
  table.insert(houses, { id = id, geometry = geometry, style = style, levels = levels })
end
for _, lot in
  streets:lots({
    kind = "strips",
    width = 9,
    depth = 19,
    min_width = 6,
    jitter = 0.4,
    terrace = 11,
    all = true,
  })
do
  local draw = stream("house", lot.id)
  local before = #houses
  if lot.use == "building" then
    for number, part in lot.terrace or {} do
      if part:area() > 32 and is_free(part) then
        local style = STYLES[1 + math.floor(draw() * #STYLES)]
        house(`{lot.id}.{number}`, part, style, if style == "villa" then 2 else 2 + math.floor(draw() * 2.2))
      end
    end
  end
  if #houses == before and lot.use ~= "blocked" then
    table.insert(gardens, lot)
  end
end

-- Existing buildings have the shape of the data.
for _, building in known do
  local levels = tonumber(building.floors or building.levels or building["building:levels"])
    or (tonumber(building.height) or 9) / 3
  local draw = stream("house", building.id)
  local use = building.use or building.building or ""
  local style = if use == "church"
      or use == "cathedral"
      or use == "chapel"
    then "church"
    elseif levels > 3.5 then "haussmann"
    elseif draw() < 0.5 then "porto"
    else "terrace_house"
  house(`there {building.id}`, building.geometry, style, math.max(1, math.floor(levels + 0.5)))
end

local homes = build.system()
homes:axiom(source(houses), function(feature)
  local style = build.style(feature.style, 1 + math.floor(random() * 60))
  return footprint(feature.geometry), build.Building(style, feature.levels, 0, "")
end)
homes:derive()

-- The ground: meadows around the district, gardens and yards in the blocks.
local blocks = {}
for _, block in streets:blocks() do
  table.insert(blocks, block.geometry)
end
quarters.areas({ box(reach + 60) }, -3, -0.05, "#84935a")
quarters.areas(blocks, -0.3, 0.13, "#77874f")

local trees = {}
for _, place in streets:verge("tree") do
  table.insert(trees, { id = place.id, geometry = { points = { place.place } }, height = 8 })
end
for _, lot in gardens do
  for number = 1, math.min(40, math.floor(lot.area / 110)) do
    local at = lot.geometry:random_point(random(), random())
    if is_free(at:buffer(2.5)) then
      table.insert(trees, {
        id = `{lot.id} {number}`,
        geometry = { points = { vec(at:x(), at:y(), 0.1) } },
        height = random(5, 11),
      })
    end
  end
end
if lod >= 3 then
  nature.trees(trees)
end
