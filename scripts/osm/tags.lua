--!strict
-- The meaning of OpenStreetMap's tags of buildings: kinds of roof, materials, and heights. Lengths are in metres.
local walls = require("templates/walls")
local tags = {}

-- The kind of roof for each value of `roof:shape`.
tags.roofs = {
  flat = "flat",
  gabled = "gable",
  gabled_height_moved = "clerestory",
  skillion = "shed",
  saltbox = "saltbox",
  hipped = "hip",
  ["half-hipped"] = "dutch_hip",
  side_hipped = "side_hip",
  ["side_half-hipped"] = "side_dutch_hip",
  ["hipped-and-gabled"] = "gablet",
  mansard = "mansard",
  gambrel = "gambrel",
  bellcast_gable = "bellcast",
  pyramidal = "pyramid",
  crosspitched = "cross_gable",
  sawtooth = "sawtooth",
  butterfly = "butterfly",
  cone = "cone",
  dome = "dome",
  onion = "onion",
  round = "round",
} :: { [string]: string }

-- Kinds of roof that need a direction for their ridge or accept one.
local DIRECTED = {
  clerestory = true,
  shed = true,
  saltbox = true,
  side_hip = true,
  side_dutch_hip = true,
  gablet = true,
  cross_gable = true,
  sawtooth = true,
  butterfly = true,
  round = true,
  gable = true,
  gambrel = true,
  bellcast = true,
} :: { [string]: boolean }

-- The colour and the image of each value of `building:material` and `roof:material`.
local MATERIALS = {
  brick = { "#a9796a", "brick" },
  stone = { "#b9b1a0", "ashlar" },
  sandstone = { "#c9b48c", "ashlar" },
  limestone = { "#d8cfb8", "ashlar" },
  granite = { "#9a9590", "ashlar" },
  marble = { "#e6e3dc" },
  wood = { "#a98a66", "boards" },
  timber_framing = { "#e6dfcf" },
  plaster = { "#e2d6c0" },
  cement_block = { "#b5b2ab" },
  concrete = { "#b0aea8" },
  glass = { "#8aa2ad" },
  mirror = { "#9fb2ba" },
  metal = { "#a3a8aa" },
  metal_plates = { "#a3a8aa" },
  steel = { "#9aa0a3" },
  roof_tiles = { "#9a5340", "tiles" },
  slate = { "#565d66", "slates" },
  copper = { "#6f9a8d" },
  zinc = { "#8d979c" },
  tin = { "#8d979c" },
  eternit = { "#8f8d88", "slates" },
  tar_paper = { "#5f5d5a" },
  asphalt = { "#5f5d5a" },
  gravel = { "#a39c8f" },
  thatch = { "#a08a5c" },
  grass = { "#7d9150" },
} :: { [string]: { string } }

local LEVEL = 3
local ROOF_RISE, ROOF_SLOPE = 5, 35

-- Usual numbers of storeys, if the map has neither height nor storeys.
local LEVELS = {
  garage = 1,
  garages = 1,
  shed = 1,
  hut = 1,
  roof = 1,
  kiosk = 1,
  greenhouse = 1,
  apartments = 5,
  office = 5,
  hotel = 6,
} :: { [string]: number }

-- Values that are not known, with their number and the first feature.
local unknown: { [string]: { count: number, first: string, tag: string, value: string } } = {}
local order: { string } = {}

-- Records a value that cannot be drawn as tagged.
local function miss(feature: any, tag: string, value: string)
  local key = `{tag}={value}`
  local known = unknown[key]
  if known then
    known.count += 1
  else
    unknown[key] = { count = 1, first = feature.id, tag = tag, value = value }
    table.insert(order, key)
  end
end

-- Warns once of each value that is not known.
function tags.report()
  for _, key in order do
    local it = unknown[key]
    local what = if it.count == 1 then "1 feature" else `{it.count} features`
    local text = `cannot draw {it.tag} = {it.value} on {what}, the first is {it.first}`
    warn(text, "the usual value is drawn instead")
  end
end

-- The material of a feature from its tags for a colour and a material.
local function surface(feature: any, colour: string?, material: string?, usual: string, prefix: string): any
  local base = if material then MATERIALS[material] else nil
  if material and not base then
    miss(feature, `{prefix}:material`, material)
  end
  local color = if base then base[1] else usual
  if colour then
    local is_known = pcall(template, panel({}), { material = { color = colour } })
    if is_known then
      color = colour
    else
      miss(feature, `{prefix}:colour`, colour)
    end
  end
  return walls.surface(color, if base then base[2] else nil, if material == "glass" then 0.2 else 0.9)
end

local WALLS = { "#e2d6c0", "#d9c7a8", "#e9dfd0", "#d5c3ae", "#dcd9d0", "#e6d2b4" }

-- The kind of roof of a feature. Mapped lines replace shapes that have no name, such as "many".
local function kind_of(feature: any, has_lines: boolean): string
  local shape = feature.roof_shape
  local kind = if shape then tags.roofs[shape] else "flat"
  if has_lines then
    return if kind and kind ~= "flat" then kind else "hip"
  elseif not kind then
    miss(feature, "roof:shape", shape)
  end
  return kind or "flat"
end

-- The height of a roof: its own, or from its angle or its storeys, or the usual one.
local function rise_of(feature: any, kind: string, plan: any): number
  if kind == "flat" then
    return 0
  elseif feature.roof_height then
    return feature.roof_height
  end
  local width = math.min(plan:envelope_width(), plan:envelope_height())
  local run = if kind == "shed" then width else width / 2
  if feature.roof_angle then
    return run * math.tan(math.rad(math.min(feature.roof_angle, 80)))
  elseif feature.roof_levels and feature.roof_levels > 0 then
    return feature.roof_levels * LEVEL
  end
  return math.min(ROOF_RISE, run * math.tan(math.rad(ROOF_SLOPE)))
end

-- The number of the longest edge of a plan, which has the door.
function tags.front(plan: any): number
  local ring = plan.rings[1]
  local longest, front = 0, 1
  for number, from in ring do
    local to = ring[number % #ring + 1]
    local length = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2)
    if length > longest + 0.01 then
      longest, front = length, number
    end
  end
  return front
end

-- The volume over one polygon of a feature: from `bottom` to `top`, with a roof of `rise` in it. Values that a part
-- lacks come from its `building`. `has_lines` is set if the roof is mapped by lines.
function tags.volume(feature: any, plan: any, building: any?, number: number, has_lines: boolean): any
  local outline = building or feature
  local kind = kind_of(feature, has_lines)
  local rise = rise_of(feature, kind, plan)
  local usual = LEVELS[feature.kind] or if plan:area() > 350 then 5 else 2
  local own = feature.height or (feature.levels and feature.levels * LEVEL + rise)
  local top = own or outline.height or (outline.levels or usual) * LEVEL + rise
  local bottom = feature.min_height or (feature.min_level or 0) * LEVEL
  if feature.kind == "roof" and bottom == 0 then
    bottom = top - rise - 0.3
  end
  if bottom >= top and not feature.height then
    -- The storeys of a raised part are counted from its bottom.
    top = bottom + (feature.levels or 1) * LEVEL + rise
  end
  if bottom >= top then
    miss(feature, "min_height", `{bottom}`)
    bottom = 0
  end
  -- A roof without walls begins at the bottom.
  rise = math.min(rise, top - bottom)
  local direction: any = feature["roof:direction"] or feature.roof_direction
  if type(direction) == "string" and not string.match(string.upper(direction), "^[NESW]+$") then
    direction = feature.roof_direction
  end
  local orientation = feature.roof_orientation
  if not DIRECTED[kind] then
    direction, orientation = nil, nil
  elseif direction then
    orientation = nil
  elseif orientation and orientation ~= "along" and orientation ~= "across" then
    miss(feature, "roof:orientation", orientation)
    orientation = nil
  end
  local levels = feature.roof_levels
  local colour = WALLS[1 + number % #WALLS]
  local roof = if kind == "flat" then "#8f8c86" else "#8a5142"
  return {
    bottom = bottom,
    walls = top - rise - bottom,
    rise = rise,
    roof = kind,
    angle = math.clamp(feature.roof_angle or ROOF_SLOPE, 1, 80),
    levels = if levels and levels > 0 and levels <= 20 then levels else nil,
    direction = direction,
    orientation = orientation,
    surface = surface(
      feature,
      feature.colour or outline.colour,
      feature.material or outline.material,
      colour,
      "building"
    ),
    cover = surface(feature, feature.roof_colour, feature.roof_material, roof, "roof"),
  }
end

return tags
