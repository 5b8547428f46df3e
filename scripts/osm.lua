--!strict
-- An extract of OpenStreetMap as it is tagged: building parts, heights, all shapes of roofs, colours and materials.
-- burgeon run scripts/osm.lua --data ../shared/data --set extract=Helsinki.osm.pbf -o helsinki.png
-- CityJSON: `-o helsinki.city.json --lod 2` writes roofs as tagged, level 2.2, and `--lod 3` also windows and doors, level 3.
local fronts = require("osm/fronts")
local ridges = require("osm/ridges")
local squares = require("osm/squares")
local tags = require("osm/tags")

local extract = param("extract", { default = "roofs.osm", doc = "The extract: a file of OpenStreetMap" })
local has_windows = param("windows", {
  default = true,
  doc = "Windows and doors on the walls. In CityJSON they are surfaces of level 3, with --lod 3",
})

local buildings = source(`{extract}:buildings`)
ridges.read(extract)
local has_parts, parts = pcall(source, `{extract}:building_parts`)

local function polygons(feature: any): { any }
  if feature.geometry.kind == "polygon" then
    return { feature.geometry }
  end
  local found = {}
  for _, part in feature.geometry:geometries() do
    if part.kind == "polygon" then
      table.insert(found, part)
    end
  end
  return found
end
local outlines: { any } = {}
local outlines_of: { [string]: { any } } = {}
for _, feature in buildings do
  for number, plan in polygons(feature) do
    local outline = { feature = feature, plan = plan, number = number, is_replaced = false }
    table.insert(outlines, outline)
    for _, square in squares.of(plan) do
      squares.put(outlines_of, square, outline)
    end
  end
end

local volumes: { any } = {}
local facades: { [string]: Facade } = {}
local PLAIN = {
  garage = true,
  garages = true,
  shed = true,
  hut = true,
  roof = true,
  column = true,
  greenhouse = true,
} :: { [string]: boolean }
local function add(feature: any, plan: any, number: number, building: any?)
  local lines = ridges.on(plan)
  local volume = tags.volume(feature, plan, building, #volumes, lines ~= nil)
  volume.lines = lines
  volume.id = if number == 1 then feature.id else `{feature.id}.{number}`
  volume.geometry = plan
  local kind: string = feature.kind or "yes"
  local material = volume.surface
  volume.look = ""
  if has_windows and not PLAIN[kind] and plan:area() > 25 and volume.walls > 2.7 then
    local is_wide = volume.walls > 18 or kind == "office" or kind == "industrial"
    volume.look = `{material.color} {material.name} {is_wide}`
    facades[volume.look] = facades[volume.look] or fronts.of(material, is_wide)
  end
  volume.front = if volume.look ~= "" and volume.bottom == 0 then tags.front(plan) else 0
  table.insert(volumes, volume)
end

-- Parts replace the volume of the outline that contains them.
if has_parts then
  for _, feature in parts do
    for number, plan in polygons(feature) do
      local inside, building = plan:point_on_surface(), nil
      for _, outline in outlines_of[squares.at(inside:x(), inside:y())] or {} do
        if outline.plan:contains(inside) then
          outline.is_replaced, building = true, outline.feature
        end
      end
      add(feature, plan, number, building)
    end
  end
end
for _, outline in outlines do
  if not outline.is_replaced then
    add(outline.feature, outline.plan, outline.number)
  end
end
tags.report()
ridges.report()

-- A polygon at a height (m).
local function lifted(plan: any, height: number): { any }
  local rings: { any } = {}
  for index, ring in plan.rings do
    local corners: { any } = {}
    for _, corner in ring do
      table.insert(corners, { corner[1], corner[2], height })
    end
    rings[index] = corners
  end
  return rings
end

local Walls, Roof = module("Walls", "height", "surface", "look"), module("Roof", "volume")
local town = lsystem({ object = footprint, interpret = "last" })
town:axiom(source(volumes), function(volume)
  local doors = if volume.front > 0 then { [volume.front] = { "entry door" } } else nil
  return footprint(lifted(volume.geometry, volume.bottom), { edge_keywords = doors }),
    Walls(volume.walls, volume.surface, volume.look),
    Roof(volume)
end)
town:interpret("Walls(height, surface, look)", function(this, height, surface, look)
  if height > 0.01 then
    this:walls({ height = height, templates = facades[look], material = surface })
  end
end)
town:interpret("Roof(volume)", function(this, volume)
  local lines = volume.lines or {}
  this:roof({
    kind = volume.roof,
    height = if volume.rise > 0 then volume.rise else nil,
    slope = volume.angle,
    levels = volume.levels,
    direction = volume.direction,
    orientation = volume.orientation,
    material = volume.cover,
    gable = volume.surface,
    border = if volume.roof == "flat" and volume.walls > 5 then 0.5 else 0,
    ridges = lines.ridges,
    edges = lines.edges,
    apexes = lines.apexes,
  })
end)
town:derive()

-- The ground under the town.
local low, high = buildings.bounds.min, buildings.bounds.max
local Plate = module("Plate", "shape", "from", "to", "color")
local plates = {}
local border = 25
local base = polygon(
  { low[1] - border, low[2] - border },
  { high[1] + border, low[2] - border },
  { high[1] + border, high[2] + border },
  { low[1] - border, high[2] + border }
)
table.insert(plates, Plate(base, -2, -0.05, "#a5a093"))
local LAYERS: { any } = {
  { "water", 0.02, "#5f8b99" },
  { "green", 0.04, "#84965a" },
  { "squares", 0.06, "#b9b3a6" },
}
for _, look in LAYERS do
  local is_there, areas = pcall(source, `{extract}:{look[1]}`)
  if is_there then
    for _, area in areas do
      for _, plan in polygons(area) do
        table.insert(plates, Plate(plan, -0.05, look[2], look[3]))
      end
    end
  end
end
local ground = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
ground:axiom(sequence(plates))
ground:interpret("Plate(shape, from, to, color)", function(this, shape, from, to, color)
  this:jump({ 0, 0, from }):color(color):polygon(shape):extrude(to - from)
end)
ground:derive(0)
