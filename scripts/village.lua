--!strict
-- A village on rolling terrain: lanes that follow the contours with cut and fill, houses and barns next to them, a
-- church, gardens, hedgerows and woods.
-- burgeon run scripts/village.lua -o village.glb
local build = require("templates/build")
local nature = require("templates/nature")
local roads = require("templates/roads")

local extent = param("extent", { default = 210, min = 150, max = 600, unit = "m", doc = "From the middle" })
local hills =
  param("hills", { default = 26, min = 0, max = 50, unit = "m", doc = "How high the ground rises" })
local with_trees = param("trees", { default = true })

-- The terrain, derived for queries and again with the lanes on it. A lane can leave the village and have houses
-- there.
local size = math.max(extent * 3, extent * 2 + 260)
local rolling =
  { "Land", "Land", "Land", "Land", change = { { -1, 1 }, { -1, 1 }, { -1, 1 }, { -1, 1 } }, decay = 0.46 }
local form = math.floor(random() * 1000000)
local function ground(lanes: Network?): Terrain
  local options: any = {
    object = terrain({
      size = size,
      levels = 8,
      decay = hills,
      rules = { Land = rolling },
      under = lanes,
      visible = lanes ~= nil,
      -- Below the sum of all changes and decays.
      base = math.min(-hills - 25, -1.85 * hills - 2),
      covers = {
        { color = "#7f8d55" },
        { color = "#93a05e", on = { patches = 0.8, scale = 130 } },
        { color = "#b0a868", on = { patches = 0.9, scale = 210 } },
        { color = "#8b7d5d", on = { slope = { 37, 46 } } },
      },
    }),
    seed = form,
  }
  return (lsystem :: any)(options):derive().objects[1] :: Terrain
end

local bare = ground()
local function height(x: number, y: number): number
  return bare:height(vec(x, y, 0))
end
local lanes = roads.grow({
  pattern = roads.contours(height, { block = 62, branching = 0.5, steepest = 5 }),
  extent = extent,
  steps = math.ceil(extent / 6),
  deepest = 2,
  join = 90,
  detour = 2,
  network = {
    on = bare,
    -- On steep ground, lanes climb rather than cut deep.
    max_slope = 11 + math.max(0, hills - 26) * 0.2,
    turning = 6,
    streets = { { width = 9.4, lanes = 2, sidewalk = 1.3 }, { width = 6.2, lanes = 1, sidewalk = 0.7 } },
    snap = 20,
    corner = 3,
    markings = false,
    paving = "#a39a86",
  },
}).objects[1] :: Network
local land = ground(lanes)

-- A ring on the ground, or inset by a distance (m).
local function laid(ring: any, sunk: number): any
  local high = {}
  for _, point in ring do
    table.insert(high, { point[1], point[2], land:height(vec(point[1], point[2], 0)) - sunk })
  end
  return { rings = { high } }
end

-- The church is next to the centre; houses and barns are where there is room.
local HOUSES = { "half_timbered", "villa", "half_timbered", "chalet", "terrace_house" }
-- Maximum height difference (m) between the ground at a door and the highest ground next to the house, and the
-- fraction that the house compensates in the ground behind.
local MOST_STEP, SUNK = 1.6, 1.1
local sites = lanes:sites({
  sizes = { { 13, 10 }, { 11, 8.5 }, { 9, 8 } },
  along = 7,
  away = 26,
  distance = 44,
  setback = 4,
  gap = 5,
})
local church: any, least = nil, math.huge
local function extremes(ring: any): (number, number)
  local low: number, high: number = math.huge, -math.huge
  for _, point in ring do
    local at: number = land:height(vec(point[1], point[2], 0))
    low = math.min(low, at)
    high = math.max(high, at)
  end
  return low, high
end
-- A position where the ground falls by more than a storey would need a blank wall, so it stays free.
local function is_level(geometry: any, most: number): boolean
  local low, high = extremes(geometry:buffer(1.5).rings[1])
  return high - low <= most
end
local church_sites = lanes:sites({
  sizes = { { 12, 24 } },
  along = 5,
  away = 40,
  distance = 36,
  setback = 4,
  gap = 5,
  shrink = 1,
})
for _, site in church_sites do
  local off = math.abs(math.sqrt(site.access.x ^ 2 + site.access.y ^ 2) - 40)
  if site.row == 0 and off < least and is_level(site.geometry, 3.2) then
    church, least = site, off
  end
end
local houses, gardens = {}, {}
for _, site in sites do
  local ring = site.geometry.rings[1]
  local away = math.sqrt(site.access.x ^ 2 + site.access.y ^ 2)
  -- The floor is at the highest ground, or lower by the sunken depth of the house; the door is in the front.
  local _, highest = extremes(ring)
  local step = highest - land:height(site.access)
  if church and site.geometry:distance(church.geometry) < 5 or not is_level(site.geometry, 2.4) then
    continue
  elseif step > MOST_STEP then
    continue
  elseif random() < 0.93 - 0.45 * away / extent then
    local is_barn = site.row > 0 or (away > extent * 0.6 and random() < 0.35)
    table.insert(houses, {
      id = site.id,
      geometry = laid(ring, math.clamp(step, 0, SUNK)),
      style = if is_barn then "chalet" else HOUSES[1 + math.floor(random() * #HOUSES)],
      levels = if is_barn then 1 else 2,
    })
    table.insert(gardens, site)
  end
end
if church then
  local ring = church.geometry.rings[1]
  table.insert(houses, { id = "church", geometry = laid(ring, 0), style = "church", levels = 1 })
end

local village = build.system()
local ways = streets(lanes:streets())
village:axiom(source(houses), function(house)
  local style = build.style(house.style, 1 + math.floor(random() * 60))
  return footprint(house.geometry, { streets = ways }), build.Building(style, house.levels, 0, "")
end)
village:derive()

-- Fruit trees behind the houses, rows of trees along the outer lanes, and woods on the hills.
if with_trees then
  local trees: { any } = {}
  local function plant(x: number, y: number, tall: number)
    local place = vec(x, y, land:height(vec(x, y, 0)) - 0.1)
    table.insert(trees, { id = `tree {#trees}`, geometry = { points = { place } }, height = tall })
  end
  local function is_free(x: number, y: number): boolean
    if lanes:distance(vec(x, y, 0)) < 8 then
      return false
    end
    for _, site in gardens do
      if math.abs(site.access.x - x) + math.abs(site.access.y - y) < 17 then
        return false
      end
    end
    return not church or church.access:distance(vec(x, y, 0)) > 36
  end
  for _, site in gardens do
    local back = math.rad(site.facing + 180)
    for number = 1, 3 do
      local x = site.access.x + math.cos(back) * (site.depth + 12) + random(-9, 9)
      local y = site.access.y + math.sin(back) * (site.depth + 12) + random(-9, 9)
      if random() < 0.7 and is_free(x, y) then
        plant(x, y, random(3.5, 6))
      end
    end
  end
  local half = size / 2 - 6
  for number = 1, 2600 do
    local x, y = random(-half, half), random(-half, half)
    local wood = noise(x / 150, y / 150, 0.5, form)
    if wood > 0.12 and lanes:distance(vec(x, y, 0)) > 46 and is_free(x, y) then
      plant(x, y, random(8, 15))
    end
  end
  nature.trees(trees)
end
