--!strict
-- A town from a data file: every building gets a style for its age, use and size, every street a pavement.
-- burgeon run scripts/town.lua --data examples/data -o town.glb
local build = require("templates/build")
local nature = require("templates/nature")

local file = param("file", { default = "town.geojson", doc = "The data; for a layer of it, FILE:LAYER" })
local forced = param("style", {
  default = "by data",
  choices = { "by data", table.unpack(build.names) },
  doc = "One style for all buildings",
})
local radius = param("radius", {
  default = 0,
  min = 0,
  max = 100000,
  unit = "m",
  doc = "Shows what lies so near to the middle; 0 for everything",
})
local east =
  param("east", { default = 0, min = -50000, max = 50000, unit = "m", doc = "Where the middle is" })
local north =
  param("north", { default = 0, min = -50000, max = 50000, unit = "m", doc = "Where the middle is" })
local trees = param("trees", { default = true, doc = "Whether trees are shown" })

-- The names of uses in the data, and their possible styles.
local BY_ERA = {
  alpine = { "chalet" },
  baroque = { "porto" },
  haussmann = { "haussmann" },
  medieval = { "half_timbered" },
  modern = { "modern_block" },
  suburban = { "villa" },
  victorian = { "terrace_house" },
}
local BY_USE = {
  church = "church",
  cathedral = "church",
  chapel = "church",
  industrial = "warehouse",
  warehouse = "warehouse",
  hangar = "warehouse",
  office = "glass_office",
  commercial = "glass_office",
  house = "villa",
  detached = "villa",
  terrace = "terrace_house",
}

-- Sorts the features by use. A feature with an area and no other use is a building.
local town = source(file)
local of: { [string]: { any } } =
  { building = {}, street = {}, tree = {}, park = {}, square = {}, water = {}, land = {} }
local lines = {}
local low, high = town.bounds.min, town.bounds.max
local x, y = (low[1] + high[1]) / 2 + east, (low[2] + high[2]) / 2 + north
local function near(point: any): boolean
  return radius == 0 or math.max(math.abs(point[1] - x), math.abs(point[2] - y)) <= radius
end
for _, feature in town do
  local geometry, use = feature.geometry, feature.use
  if geometry.kind == "line" then
    table.insert(lines, geometry)
    local points = {}
    for _, point in geometry.points do
      if near(point) then
        table.insert(points, point)
      end
    end
    if #points > 1 then
      table.insert(
        of.street,
        { id = feature.id, points = points, width = feature.width, bridge = feature.bridge }
      )
    end
  elseif geometry.kind == "point" then
    if near(geometry.points[1]) then
      table.insert(of.tree, feature)
    end
  elseif use and of[use] then
    -- A partial view is on a plate of its own.
    if radius == 0 then
      table.insert(of[use], feature)
    end
  elseif near(geometry.rings[1][1]) then
    table.insert(of.building, feature)
  end
end

local bounds = town.bounds
if radius > 0 then
  bounds = { min = { x - radius, y - radius }, max = { x + radius, y + radius } }
end
nature.ground(of, bounds)
nature.streets(of.street)
if trees and lod >= 3 then
  nature.trees(of.tree)
end

local function one_of(names: { string }): string
  return names[math.min(#names, 1 + math.floor(random() * #names))]
end

local function extent(geometry: any): (number, number)
  local area, around = 0, 0
  local ring = geometry.rings[1]
  for index, a in ring do
    local b = ring[index % #ring + 1]
    area += (a[1] * b[2] - b[1] * a[2]) / 2
    around += math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
  end
  return area, around
end

-- A style for a building with only a known size.
local function by_size(geometry, height: number): string
  local area, around = extent(geometry)
  -- Sheds and halls are low for their depth.
  local depth = 4 * area / around
  if area > 500 and height < 14 and height < 0.8 * depth then
    return if height < 9 then "warehouse" else one_of({ "modern_block", "haussmann" })
  elseif height >= 30 then
    return one_of({ "modern_block", "glass_office" })
  elseif height >= 13 then
    return one_of({ "haussmann", "haussmann", "haussmann", "modern_block", "terrace_house" })
  elseif height >= 8 then
    return one_of({ "terrace_house", "porto", "villa", "porto" })
  end
  return "villa"
end

local function style_of(feature, height: number): string
  if forced ~= "by data" then
    return forced
  end
  local use = BY_USE[feature.use or feature.building or ""]
  local era = feature.era and BY_ERA[feature.era]
  if feature.style and build.usual[feature.style] then
    return feature.style
  elseif use == "church" or use == "warehouse" or (use == "glass_office" and height > 9) then
    return use
  end
  return if era then one_of(era) else use or by_size(feature.geometry, height)
end

-- Numbers in the data can be texts such as "12 m".
local function number(value): number?
  return if value then tonumber(string.match(tostring(value), "^%s*(%d+%.?%d*)")) else nil
end

local along = if #lines > 0 then streets(lines) else nil
local houses = build.system()
houses:axiom(source(of.building), function(feature)
  local levels = number(feature.levels)
  local height = number(feature.height) or (levels or 3) * 3.1
  if height < 2 then
    height = (levels or 1) * 3
  end
  local style = build.style(style_of(feature, height), 1 + math.floor(random() * 60))
  local known: FootprintOptions = { streets = along, attributes = { name = feature.name } }
  return footprint(feature.geometry, known),
    build.Building(style, build.levels(style, height), height, feature.use or "")
end)
houses:derive()
