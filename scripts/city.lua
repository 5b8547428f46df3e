--!strict
-- A whole city from rules and a seed: main and side streets, a river with bridges, quarters of different kinds, lots,
-- buildings and a skyline, on flat land or on hills. Buildings near `detail` have facades; distant buildings have
-- photos of windows.
-- burgeon run scripts/city.lua -o city.glb
local build = require("templates/build")
local nature = require("templates/nature")
local quarters = require("templates/quarters")
local roads = require("templates/roads")
local skyline = require("templates/skyline")

local extent = param("extent", { default = 650, min = 250, max = 3000, unit = "m", doc = "From the middle" })
local with_river = param("river", { default = true })
local highest = param("highest", {
  default = 70,
  min = 15,
  max = 200,
  unit = "m",
  doc = "The usual height in the middle; towers are higher",
})
local detail =
  param("detail", { default = 130, min = 0, max = 3000, unit = "m", doc = "How far there are facades" })
local with_trees = param("trees", { default = true })
local hills = param(
  "hills",
  { default = 0, min = 0, max = 80, unit = "m", doc = "How high the ground rises; 0 if it is flat" }
)
local heart = param("heart", {
  default = "towers",
  choices = { "towers", "old town", "boulevards" },
  doc = "What stands in the middle",
})

-- The river runs from west to east past the centre.
local WATER = -3.5
local course = math.floor(random() * 1000)
local aside = extent * 0.33
local function midstream(x: number): number
  return -aside + extent * 0.22 * noise(x / (extent * 0.9), 0.5, course)
end
local function river(far: number, width: number): any
  local south: { any }, north: { any } = {}, {}
  for step = 0, 40 do
    local x = far * (step / 20 - 1)
    local y = midstream(x)
    table.insert(south, { x, y - width / 2 })
    table.insert(north, 1, { x, y + width / 2 })
  end
  return polygon(table.move(north, 1, #north, #south + 1, south))
end
local far = extent * 1.6
local wide = 30 + extent * 0.05
local water: any = if with_river then river(far, wide) else nil
local quays: any = if with_river then river(far, wide + 14) else nil
-- Areas for buildings end slightly before these areas, so that rounding causes no overlap.
local banks: any = if with_river then river(far, wide + 14.1) else nil

-- The terrain, if the ground is not flat: hills, and the valley of the river. The script derives it twice: for
-- queries, and with the streets on it.
local middle = { 0, extent * 0.05 }
local function rise(from: number, to: number, at: number): number
  local along = math.clamp((at - from) / (to - from), 0, 1)
  return along * along * (3 - 2 * along)
end
local function form(x: number, y: number): number
  local wild = 0.5 + 0.5 * noise(x / (extent * 0.75), y / (extent * 0.75), 0.5, course + 1)
  local high = 0.5
    + hills * wild * (0.35 + 0.65 * rise(0, extent * 0.7, math.sqrt(x * x + (y - middle[2]) ^ 2)))
  if not with_river then
    return high
  end
  local off = math.abs(y - midstream(x)) - wide / 2
  local valley = 0.3 + (high - 0.3) * rise(12, extent * 0.6, off)
  return WATER - 3 + (valley + 3 - WATER) * rise(-8, 6, off)
end
local size = extent * 2.6
local Ground = module("Ground", "height", "form", "x", "y", "width")
local cells = lsystem()
cells:axiom(Ground(0, 0, 0, 0, size))
cells:rule("Ground(height, form, x, y, width)", function(this, _, _, x: number, y: number, width: number)
  local quarter = width / 4
  local function quadrant(x: number, y: number)
    return Ground(0, form(x, y), x, y, width / 2)
  end
  return quadrant(x - quarter, y + quarter),
    quadrant(x + quarter, y + quarter),
    quadrant(x - quarter, y - quarter),
    quadrant(x + quarter, y - quarter)
end)
local function ground(streets: Network?): Terrain
  local options: any = {
    object = terrain({
      size = size,
      levels = math.clamp(math.ceil(math.log(size / 4.5, 2)), 3, 10),
      rules = cells,
      under = streets,
      visible = streets ~= nil,
      base = WATER - 20,
      water = if with_river then { level = WATER } else nil,
      covers = {
        { color = "#7c8a58" },
        { color = "#8a935c", on = { patches = 0.8, scale = 190 } },
        { color = "#8b7d5d", on = { slope = { 26, 38 } } },
      },
    }),
  }
  return (lsystem :: any)(options):derive().objects[1] :: Terrain
end
local bare = if hills > 0 then ground() else nil

-- Tests if a street may be proposed: bridges cross the river only within the town, and not next to each other.
local function allowed(streets: Network, from: Vector, to: Vector, depth: number): boolean
  local length = from:distance(to)
  local off = from.y - midstream(from.x)
  if not with_river or math.abs(off) > 1.5 * length + wide + 20 then
    return true
  end
  local out, at, touches = (to - from):unit(), from, false
  for far = 0, length + 3 * wide, 6 do
    at += 6 * out
    local here = at.y - midstream(at.x)
    touches = touches or math.abs(here) < wide / 2 + 8
    if not touches and far > length + 12 then
      return true
    elseif (here > 0) ~= (off > 0) then
      local apart = math.clamp(extent * 0.17, 60, 150)
      for aside = -apart, apart, 10 do
        local x = at.x + aside
        if streets:distance(vec(x, midstream(x), 0)) < wide / 2 + 4 then
          return false
        end
      end
      return math.abs(at.x) < extent * (if depth < 2 then 0.66 else 0.5)
    end
  end
  return true
end

-- Quarters: their positions and street patterns. Main streets lead to the boundary of the surrounding country.
local RIM = extent * 1.1 + 60
-- Slightly inside the boundary of the ground, because the corners of a street also need ground.
local edge = size / 2 - 8
local country: any = polygon({ { -edge, -edge }, { edge, -edge }, { edge, edge }, { -edge, edge } })
if not bare then
  local ring = {}
  for step = 1, 72 do
    local angle = math.rad(step * 5)
    table.insert(ring, { math.cos(angle) * RIM, math.sin(angle) * RIM })
  end
  country = polygon(ring)
end
local places = quarters.places(extent, heart)
local streets = roads.grow({
  pattern = quarters.pattern(places),
  centres = { middle },
  extent = extent,
  steps = math.ceil(extent / 22) + 4,
  dead_ends = "remove",
  exits = { count = 6, rim = country },
  allowed = allowed,
  network = {
    streets = {
      { width = 25, lanes = 4, median = 2, sidewalk = 4, trees = 11, lamps = 30 },
      { width = 15, lanes = 2, parking = 2.1, sidewalk = 2.6, lamps = 30 },
      { width = 10.5, lanes = 2, sidewalk = 2 },
    },
    snap = 26,
    min_angle = 52,
    water = if with_river then { quays } else {},
    bridge = wide + 60,
    water_level = WATER,
    square_ends = true,
    on = bare,
    max_slope = 13,
  },
}).objects[1] :: Network

-- The rest of an area outside of the river.
local function dry(geometry: any): any
  return if with_river and geometry:intersects(banks) then geometry:difference(banks) else geometry
end

-- The flat ground: the surrounding country, the blocks in the colours of their quarters, and the water.
local land: Terrain? = if bare then ground(streets) else nil
local function height(x: number, y: number): number
  return if land then land:height(vec(x, y, 0)) else 0
end
if not land then
  quarters.areas({ if with_river then country:difference(water) else country }, -7, -0.06, "#7c8a58")
  if with_river then
    quarters.areas({ country:intersection(water) }, -7, WATER, "#56727c")
  end
end

-- Fields in the surrounding country, on flat ground.
local FIELD = { 74, 50 }
local FIELDS = { "#8d9a58", "#a39f63", "#768452", "#93a066", "#b0a56b" }
if not land then
  local fields: { { any } } = {}
  local along = vec(math.cos(course), math.sin(course), 0)
  local across = vec(-along.y, along.x, 0)
  local columns, rows = math.ceil(RIM / FIELD[1]), math.ceil(RIM / FIELD[2])
  for column = -columns, columns do
    for row = -rows, rows do
      local ring, is_free = {}, random() < 0.85
      for _, corner in { { 0.03, 0.03 }, { 0.97, 0.03 }, { 0.97, 0.97 }, { 0.03, 0.97 } } do
        -- Every other column is shifted.
        local up = row + corner[2] + 0.5 * (column % 2)
        local at = along * (FIELD[1] * (column + corner[1])) + across * (FIELD[2] * up)
        is_free = is_free
          and at.x * at.x + at.y * at.y < (RIM - 4) ^ 2
          and streets:distance(at) > 22
          and not (with_river and math.abs(at.y - midstream(at.x)) < wide / 2 + 16)
        table.insert(ring, { at.x, at.y })
      end
      local middle = polygon(ring):centroid():place() :: Vector
      if is_free and streets:distance(middle) > 36 then
        local number = 1 + math.floor(random() * #FIELDS)
        fields[number] = fields[number] or {}
        table.insert(fields[number], polygon(ring))
      end
    end
  end
  for number, of_color in fields do
    quarters.areas(of_color, -0.5, 0, FIELDS[number])
  end
end

-- Blocks with the properties of their quarter. Areas without a building are green.
local green: { any } = {}
local of: { [string]: { any } } = {}
local plots: { [string]: { any } } = {}
for _, block in streets:blocks() do
  local kind = quarters.at(places, block.geometry:centroid())
  local left = dry(block.geometry)
  if not left:is_empty() then
    of[kind] = of[kind] or {}
    plots[kind] = plots[kind] or {}
    table.insert(plots[kind], left)
    for _, part in left:geometries() do
      local area = part:area()
      if area > 250 then
        table.insert(of[kind], { id = block.id, geometry = part })
      else
        -- A small rest of a block next to the river is a garden.
        table.insert(green, { id = `{block.id} {#green}`, geometry = part, area = area, use = "rest" })
      end
    end
  end
end

-- Buildings with complete facades, and distant buildings.
local near: { any }, distant: { any } = {}, {}
local yards: { any } = {}
local plan: { any } = {}
for kind, blocks in of do
  local quarter = quarters.kinds[kind]
  if not land then
    quarters.areas(plots[kind], -0.3, 0.14, quarter.ground)
  end
  local options = table.clone(quarter.lots)
  options.blocks, options.all, options.seed = blocks, true, kind
  local lots = {}
  for _, lot in streets:lots(options) do
    table.insert(plan, {
      id = lot.id,
      geometry = lot.geometry,
      quarter = kind,
      use = lot.use,
      area = lot.area,
      is_corner = lot.corner,
    })
    if lot.use == "building" then
      table.insert(lots, lot)
    else
      table.insert(green, lot)
    end
  end
  local buildings, empty = quarter.buildings(lots, highest, extent)
  if kind == "rows" then
    table.move(lots, 1, #lots, #yards + 1, yards)
  end
  -- A lot without room for a building is a garden.
  table.move(empty, 1, #empty, #green + 1, green)
  for _, building in if land then quarters.raised(buildings, height) else buildings do
    local at = building.lot.access
    local away = math.sqrt((at.x - middle[1]) ^ 2 + (at.y - middle[2]) ^ 2)
    local is_near = away < detail and building.style and building.tier == 1
    table.insert(if is_near then near else distant, building)
  end
end
-- A layer for maps: `-o city.gpkg`.
source(plan, { table = "lots" })

local parks = {}
for _, lot in green do
  if lot.use == "park" or lot.use == "court" then
    table.insert(parks, lot.geometry)
  end
end
if not land then
  quarters.areas(parks, 0, 0.2, "#6f8a50")
end

local houses = build.system()
local ways = quarters.ways(streets)
houses:axiom(source(near), function(feature)
  local style = build.style(feature.style, 1 + math.floor(random() * 60))
  return footprint(feature.geometry, { attributes = quarters.attributes(feature), streets = ways }),
    build.Building(style, build.levels(style, feature.height), feature.height, "")
end)
houses:derive()
quarters.distant(distant)

if with_trees then
  local trees = {}
  for _, place in streets:verge("tree") do
    table.insert(trees, { id = place.id, geometry = { points = { place.place } }, height = 8 })
  end
  for _, lot in green do
    for number = 1, math.min(60, math.floor(lot.area / 90)) do
      local at = lot.geometry:random_point(random(), random())
      local x, y = at:x(), at:y()
      table.insert(trees, {
        id = `{lot.id} {number}`,
        geometry = { points = { vec(x, y, height(x, y)) } },
        height = random(6, 13),
      })
    end
  end
  -- Small trees and sheds behind row houses.
  local sheds = {}
  for _, lot in yards do
    local chance, behind = random(), random(15, math.max(16, lot.depth - 2.5))
    local way = math.rad(lot.facing + 180)
    local x, y = lot.access.x + math.cos(way) * behind, lot.access.y + math.sin(way) * behind
    if chance < 0.8 and point(x, y):buffer(1.3):within(lot.geometry) then
      local place = vec(x, y, height(x, y) + (if land then 0 else 0.14))
      if chance < 0.35 then
        local tree = { id = `yard {lot.id}`, geometry = { points = { place } }, height = random(3.5, 6) }
        table.insert(trees, tree)
      else
        table.insert(sheds, { id = `shed {lot.id}`, place = place, facing = lot.facing })
      end
    end
  end
  nature.sheds(sheds)
  -- Woods in the surrounding country.
  for wood = 1, 26 do
    local angle, away = math.rad(random(0, 360)), extent * random(0.8, 1.12)
    for number = 1, 16 do
      local x = math.cos(angle) * away + random(-1, 1) * random(5, 45)
      local y = math.sin(angle) * away + random(-1, 1) * random(5, 45)
      local place = vec(x, y, height(x, y))
      if streets:distance(place) > 55 and not (with_river and quays:distance(point(x, y)) < 4) then
        local id = `wood {wood} {number}`
        table.insert(trees, { id = id, geometry = { points = { place } }, height = random(8, 15) })
      end
    end
  end
  nature.trees(trees)
end

-- Lamps within the visible distance (m) north, east, south and west of the centre.
local LIT = 700
local lamps = {}
for _, lamp in streets:verge("lamp") do
  if math.abs(lamp.place.x) < LIT and math.abs(lamp.place.y) < LIT then
    table.insert(lamps, lamp)
  end
end
nature.lamps(lamps)
