--!strict
-- Tracery of Gothic windows: plates of stone with pierced lights, in front of glass. Each function takes an upright face, and
-- returns the wall with its hole, the reveal, the stone and the glass.
local openings = require("./openings")
local outlines = require("./outlines")
local tracery = {}

-- With types, since those of required files are unknown.
local foil: (x: number, y: number, radius: number, count: number, turn: number?) -> { any } = outlines.foil
local move: (outline: any, x: number, y: number) -> { any } = outlines.move
local make_wall: (face: Shape, holes: { any }) -> Shape = openings.wall
local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local sweep_across: (face: Shape, profile: any, x: number, width: number) -> Shape = outlines.across

local WINDOW = {
  width = 2.4,
  height = 5.2,
  sill = 1, -- height of the sill above the lower edge
  lancets = 2, -- 1, 2 or 4
  foils = 6, -- lobes of the roses
  depth = 0.35, -- of the reveal
  bar = 0.14, -- width of the mullions
  bars = 5, -- horizontal iron bars in front of the glass; 0 for none
  slope = 0.25, -- height of the weathered sill
  label = 0.12, -- projection of the hood mould over the arch; 0 for none
  wall = true,
  glass = "#34455a",
  stone = "#d9cfb8",
}
local ROSE = {
  radius = 2.2,
  petals = 12,
  depth = 0.4,
  bar = 0.12,
  label = 0.14,
  wall = true,
  glass = "#33415c",
  stone = "#d9cfb8",
}

-- Adds the outlines of the lights of an arch that is `width` wide, with feet at { x, y } and the springing line at `spring`.
local function add_lights(
  lights: { any },
  x: number,
  y: number,
  spring: number,
  width: number,
  options: any,
  count: number
)
  local bar = options.bar
  if count == 1 then
    local clear = width - bar
    local outline = outlines.arch("pointed", clear, spring - y + outlines.rise("pointed", clear))
    table.insert(lights, move(outline, x + bar / 2, y))
    return
  end
  local half = width / 2
  add_lights(lights, x, y, spring, half, options, count / 2)
  add_lights(lights, x + half, y, spring, half, options, count / 2)
  -- The circle that touches both lower arches and the upper one: of a quarter of the width.
  local radius, up = width / 4, width * math.sqrt(5) / 4
  table.insert(lights, foil(x + half, spring + up, radius - bar * 0.75, options.foils))
  -- The spandrels beside the circle, and the one below it.
  local small = width * 0.038 - bar * 0.12
  if small > 0.03 then
    table.insert(lights, foil(x + half, spring + width * 0.165, small, 3, 270))
  end
end

-- Returns a pointed window of 1, 2 or 4 lancets below a rose: options as in WINDOW.
function tracery.window(face: Shape, given: any?): { Shape }
  local options = outlines.options("tracery.window", WINDOW, given)
  local owner = "tracery.window"
  outlines.require_slope(owner, face, true)
  local size, width, depth = face:size(), options.width, options.depth
  outlines.require_room(owner, "width", width + 0.02, size.x)
  outlines.require_room(owner, "height", options.sill + options.height + 0.02, size.y)
  if options.lancets ~= 1 and options.lancets ~= 2 and options.lancets ~= 4 then
    error(`{owner}: lancets is {options.lancets}: use 1, 2 or 4`, 2)
  elseif width / options.lancets < 2 * options.bar then
    error(`{owner}: lights are too narrow: use a width above {2 * options.bar * options.lancets} m`, 2)
  end
  local hole = outlines.arch("pointed", width, options.height)
  hole = move(hole, (size.x - width) / 2, options.sill)
  local list: { Shape } = {}
  if options.wall then
    table.insert(list, make_wall(face, { hole }))
  end
  local pane = place_outline(face, hole, nil, -depth)
  local reveal = pane:extrude(depth):joined_faces("tag:extrude.side")
  if reveal then
    table.insert(list, reveal:reverse():color(options.stone))
  end
  table.insert(list, pane:shift(vec(0, 0, 0.02)):color(options.glass))
  -- The outer arch leaves half a bar; the lights leave the other half.
  local margin: number, lights: { any } = options.bar * 0.4, {}
  local spring = options.height - outlines.rise("pointed", width)
  add_lights(lights, margin, margin + options.bar / 2, spring, width - 2 * margin, options, options.lancets)
  local plate = place_outline(pane, outlines.of(pane), lights, 0.06)
  table.insert(list, plate:extrude(0.16):color(options.stone))
  for number = 1, options.bars do
    local y = spring * number / (options.bars + 1)
    table.insert(
      list,
      make_box(pane, { margin, width - margin }, { y, y + 0.025 }, { 0.03, 0.055 }):color("#23272b")
    )
  end
  if options.slope > 0 then
    local profile = { { -depth, 0 }, { 0.08, -0.1 }, { 0.08, -0.04 }, { -depth + 0.06, options.slope } }
    local lower = face:shift(vec(0, options.sill, 0))
    table.insert(list, sweep_across(lower, profile, (size.x - width) / 2, width):color(options.stone))
  end
  if options.label > 0 then
    local band = 0.14
    local wide = width + 2 * band
    local rise = outlines.rise("pointed", wide)
    local outer = move(outlines.arch("pointed", wide, rise), -band, spring)
    local inner = move(outlines.arch("pointed", width, rise * width / wide), 0, spring)
    local hood = outlines.band(outer, inner)
    table.insert(
      list,
      place_outline(face, move(hood, (size.x - width) / 2, options.sill))
        :extrude(options.label)
        :color(options.stone)
    )
  end
  return list
end

-- Returns a wheel window: petals around a foil, and a ring of roundels, in the middle of a face: options as in ROSE.
function tracery.rose(face: Shape, given: any?): { Shape }
  local options = outlines.options("tracery.rose", ROSE, given)
  local owner, radius, bar, petals = "tracery.rose", options.radius, options.bar, options.petals
  outlines.require_slope(owner, face, true)
  local size = face:size()
  outlines.require_room(owner, "diameter", 2 * radius + 0.02, math.min(size.x, size.y))
  if petals < 5 then
    error(`{owner}: petals is {petals}: use at least 5`, 2)
  elseif radius * math.sin(math.pi / petals) * 0.7 < bar then
    error(`{owner}: petals are too narrow: use fewer petals or a larger radius`, 2)
  end
  local x, y = size.x / 2, size.y / 2
  local hole = outlines.circle(x, y, radius, 48)
  local list: { Shape } = {}
  if options.wall then
    table.insert(list, make_wall(face, { hole }))
  end
  local pane = place_outline(face, hole, nil, -options.depth)
  local reveal = pane:extrude(options.depth):joined_faces("tag:extrude.side")
  if reveal then
    table.insert(list, reveal:reverse():color(options.stone))
  end
  table.insert(list, pane:shift(vec(0, 0, 0.02)):color(options.glass))
  -- The lights, around the middle of the pane.
  local lights: { any } = { foil(radius, radius, radius * 0.2, math.min(petals, 8)) }
  local from, to = radius * 0.29, radius * 0.7
  for number = 0, petals - 1 do
    local axis = 2 * math.pi * number / petals + math.pi / 2
    local along, across = { math.cos(axis), math.sin(axis) }, { -math.sin(axis), math.cos(axis) }
    local narrow = math.max(0.02, from * math.tan(math.pi / petals) - bar / 2)
    local wide = to * math.tan(math.pi / petals) - bar / 2
    local points: { any } = {}
    local function add(far: number, aside: number)
      table.insert(points, {
        radius + far * along[1] + aside * across[1],
        radius + far * along[2] + aside * across[2],
      })
    end
    add(from, narrow)
    add(from, -narrow)
    for step = 0, 8 do
      local angle = -math.pi / 2 + math.pi * step / 8
      add(to + wide * math.cos(angle) * 0.9, wide * math.sin(angle))
    end
    table.insert(lights, points)
    local between = axis + math.pi / petals
    local far = radius * 0.885
    local roundel = math.min(radius * 0.115 - bar * 0.5, far * math.sin(math.pi / petals) - bar * 0.5)
    if roundel > 0.03 then
      table.insert(
        lights,
        foil(
          radius + far * math.cos(between),
          radius + far * math.sin(between),
          roundel,
          4,
          math.deg(between)
        )
      )
    end
  end
  local plate = place_outline(pane, outlines.circle(radius, radius, radius, 48), lights, 0.06)
  table.insert(list, plate:extrude(0.18):color(options.stone))
  if options.label > 0 then
    local ring = place_outline(face, outlines.circle(x, y, radius + 0.2, 48), { hole })
    table.insert(list, ring:extrude(options.label):color(options.stone))
  end
  return list
end

return tracery
