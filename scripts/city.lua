--!strict
-- A whole city from nothing but rules and a seed: main and side streets, a river with bridges, quarters of their own kind,
-- lots, buildings and a skyline. Near `detail` every building has its facades; farther off, photos of windows stand in.
-- burgeon run scripts/city.lua -o city.glb
local build = require("templates/build")
local nature = require("templates/nature")
local quarters = require("templates/quarters")
local roads = require("templates/roads")
local skyline = require("templates/skyline")

local extent = param("extent", { default = 650, min = 250, max = 3000, unit = "m", text = "From the middle" })
local with_river = param("river", { default = true })
local highest = param("highest", {
  default = 70,
  min = 15,
  max = 200,
  unit = "m",
  text = "The usual height in the middle; towers are higher",
})
local detail =
  param("detail", { default = 130, min = 0, max = 3000, unit = "m", text = "How far there are facades" })
local with_trees = param("trees", { default = true })

-- The river runs from west to east past the middle.
local WATER = -3.5
local course = math.floor(random() * 1000)
local aside = extent * 0.33
local function river(far: number, width: number): any
  local south: { any }, north: { any } = {}, {}
  for step = 0, 40 do
    local x = far * (step / 20 - 1)
    local y = -aside + extent * 0.22 * noise(x / (extent * 0.9), 0.5, course)
    table.insert(south, { x, y - width / 2 })
    table.insert(north, 1, { x, y + width / 2 })
  end
  return polygon(table.move(north, 1, #north, #south + 1, south))
end
local far = extent * 1.6
local wide = 30 + extent * 0.05
local water: any = if with_river then river(far, wide) else nil
local quays: any = if with_river then river(far, wide + 14) else nil

-- Quarters: which is where, and how its streets run.
local middle = { 0, extent * 0.05 }
local places = quarters.places(extent)
local streets = roads.grow({
  pattern = quarters.pattern(places),
  centres = { middle },
  extent = extent,
  steps = math.ceil(extent / 22),
  dead_ends = "remove",
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
  },
}).objects[1] :: Network

-- What is left of an area beside the river.
local function dry(geometry: any): any
  return if with_river and geometry:intersects(quays) then geometry:difference(quays) else geometry
end

-- The ground: the country around, the blocks, each in the colour of its quarter, and the water.
local country = {}
for step = 1, 72 do
  local angle = math.rad(step * 5)
  table.insert(country, { math.cos(angle) * (extent * 1.1 + 60), math.sin(angle) * (extent * 1.1 + 60) })
end
local land = polygon(country)
quarters.areas({ if with_river then land:difference(water) else land }, -7, -0.06, "#7c8a58")
if with_river then
  quarters.areas({ land:intersection(water) }, -7, WATER, "#56727c")
end

-- Blocks, each of the kind of its quarter.
local of: { [string]: { any } } = {}
local ground: { [string]: { any } } = {}
for _, block in streets:blocks() do
  local kind = quarters.at(places, block.geometry:centroid())
  local left = dry(block.geometry)
  if not left:is_empty() then
    of[kind] = of[kind] or {}
    ground[kind] = ground[kind] or {}
    table.insert(ground[kind], left)
    for _, part in left:geometries() do
      if part:area() > 250 then
        table.insert(of[kind], { id = block.id, geometry = part })
      end
    end
  end
end

-- Buildings with all of their facades, and those that are only seen from afar.
local near: { any }, distant: { any }, green: { any } = {}, {}, {}
for kind, blocks in of do
  local quarter = quarters.kinds[kind]
  quarters.areas(ground[kind], -0.3, 0.14, quarter.ground)
  local options = table.clone(quarter.lots)
  options.blocks, options.all, options.seed = blocks, true, kind
  local lots = {}
  for _, lot in streets:lots(options) do
    if lot.use == "building" then
      table.insert(lots, lot)
    elseif lot.use == "park" or lot.use == "court" then
      table.insert(green, lot)
    end
  end
  for _, building in quarter.buildings(lots, highest, extent) do
    local at = building.lot.access
    local away = math.sqrt((at.x - middle[1]) ^ 2 + (at.y - middle[2]) ^ 2)
    local is_near = away < detail and building.style and building.tier == 1
    table.insert(if is_near then near else distant, building)
  end
end
quarters.areas(
  (function()
    local parks = {}
    for _, lot in green do
      table.insert(parks, lot.geometry)
    end
    return parks
  end)(),
  0,
  0.2,
  "#6f8a50"
)

local houses = build.system()
houses:axiom(source(near), function(feature)
  local style = build.style(feature.style, 1 + math.floor(random() * 60))
  return footprint(feature.geometry, { attributes = { kind = feature.kind } }),
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
      table.insert(trees, {
        id = `{lot.id} {number}`,
        geometry = { points = { vec(at:x(), at:y(), 0) } },
        height = random(6, 13),
      })
    end
  end
  -- Woods in the country around.
  for wood = 1, 26 do
    local angle, away = math.rad(random(0, 360)), extent * random(0.8, 1.12)
    for number = 1, 22 do
      local x = math.cos(angle) * away + random(-1, 1) * random(5, 45)
      local y = math.sin(angle) * away + random(-1, 1) * random(5, 45)
      local place = vec(x, y, 0)
      if streets:distance(place) > 55 and not (with_river and quays:distance(point(x, y)) < 4) then
        local id = `wood {wood} {number}`
        table.insert(trees, { id = id, geometry = { points = { place } }, height = random(8, 15) })
      end
    end
  end
  nature.trees(trees)
end
