--!strict
-- Windows and doors. Each function takes an upright face, the wall around one opening, and returns the wall with its hole,
-- the reveal, and all that fills and surrounds it.
local outlines = require("./outlines")
local openings = {}

-- With types, since those of required files are unknown.
local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned

local WINDOW = {
  kind = "rectangle", -- "rectangle", "segmental", "round" or "pointed"
  width = 1.2,
  height = 1.6,
  sill = 0.9, -- height of the sill above the lower edge
  depth = 0.22, -- of the reveal
  frame = 0.07,
  columns = 2, -- of panes
  rows = 2,
  surround = 0.12, -- width of the band around the opening; 0 for none
  bench = 0.08, -- projection of the sill; 0 for none
  keystone = false,
  wall = true, -- the wall around the opening
  glass = "#3a4956",
  wood = "#e9e6df",
  trim = "#e4dccb",
}
local DOOR = {
  kind = "rectangle",
  width = 1.3,
  height = 2.4,
  sill = 0,
  depth = 0.22,
  frame = 0.07,
  leaves = 2,
  light = 0, -- height of a window above the door
  surround = 0.16,
  keystone = false,
  step = 0.3, -- depth of the step in front; 0 for none
  wall = true,
  glass = "#3a4956",
  wood = "#5a3d2b",
  trim = "#e4dccb",
}
-- Slope of the gable of a portal.
local STEEP = 1.9
local PORTAL = {
  width = 1.8,
  height = 4.2,
  orders = 4, -- arches, each smaller and deeper than the one before
  step = 0.22, -- width and depth of an arch
  lintel = 2.4, -- height of the doors
  gable = 0.26, -- width of the coping of a gable around the arches; 0 for none
  trim = "#d9cfb8",
  wood = "#4c3423",
  wall = true,
}

-- Returns the wall of a face around holes, in no colour of its own. Holes that begin at the lower edge become notches; give
-- them from left to right.
function openings.wall(face: Shape, holes: { any }): Shape
  local outline, inside: { any } = outlines.of(face), {}
  local ring: { any } = { outline[1] }
  for _, hole in holes do
    if hole[1][2] > 1e-6 then
      table.insert(inside, hole)
      continue
    end
    table.insert(ring, hole[1])
    for at = #hole, 2, -1 do
      table.insert(ring, hole[at])
    end
  end
  table.move(outline, 2, #outline, #ring + 1, ring)
  return place_outline(face, ring, inside)
end

-- Adds the reveal behind an outline.
local function add_reveal(list: { Shape }, pane: Shape, depth: number)
  local sides = pane:extrude(depth):joined_faces("tag:extrude.side")
  if sides then
    table.insert(list, sides:reverse())
  end
end

-- Returns the outline of an opening in the middle of a face; refuses what does not fit.
local function middle(owner: string, face: Shape, options: any): { { number } }
  outlines.require_slope(owner, face, true)
  local size = face:size()
  outlines.require_room(owner, "width", options.width + 0.02, size.x)
  outlines.require_room(owner, "height", options.sill + options.height + 0.02, size.y)
  local outline = outlines.arch(options.kind, options.width, options.height)
  return outlines.move(outline, (size.x - options.width) / 2, options.sill)
end

-- Adds the surround of an arch, and its keystone.
local function add_surround(list: { Shape }, face: Shape, hole: any, options: any)
  local band, size = options.surround, face:size()
  if band <= 0 then
    return
  end
  local x = (size.x - options.width) / 2
  local outer = outlines.arch(
    options.kind,
    options.width + 2 * band,
    options.height + band,
    if options.kind == "rectangle"
      then nil
      else outlines.rise(options.kind, options.width) * (1 + 2 * band / options.width)
  )
  outer = outlines.move(outer, x - band, options.sill)
  table.insert(list, place_outline(face, outlines.band(outer, hole)):extrude(0.05):color(options.trim))
  if options.keystone then
    local top = options.sill + options.height
    local stone = {
      { size.x / 2 - band * 0.5, top - 0.02 },
      { size.x / 2 + band * 0.5, top - 0.02 },
      { size.x / 2 + band * 0.8, top + band * 1.5 },
      { size.x / 2 - band * 0.8, top + band * 1.5 },
    }
    table.insert(list, place_outline(face, stone):extrude(0.11):color(options.trim))
  end
end

-- Adds a pane with its frame and glazing bars, `depth` behind the face.
local function add_panes(list: { Shape }, face: Shape, hole: any, options: any)
  local pane = place_outline(face, hole, nil, -options.depth)
  table.insert(list, pane:color(options.glass))
  local inner = pane:setback(options.frame)[1]
  if not inner then
    return
  end
  local ring = place_outline(pane, outlines.of(pane), { outlines.of(inner, pane) })
  table.insert(list, ring:extrude(0.06):color(options.wood))
  local size, bar = inner:size(), options.frame * 0.6
  local function add_bar(x: number, y: number, width: number, height: number)
    local part = inner:crop(x, y, width, height)
    if part then
      table.insert(list, part:extrude(0.05):color(options.wood))
    end
  end
  for number = 1, options.columns - 1 do
    add_bar(size.x * number / options.columns - bar / 2, 0, bar, size.y)
  end
  for number = 1, options.rows - 1 do
    add_bar(0, size.y * number / options.rows - bar / 2, size.x, bar)
  end
end

-- Returns a window with reveal, frame, glazing bars, surround and sill: options as in WINDOW.
function openings.window(face: Shape, given: any?): { Shape }
  local options = outlines.options("openings.window", WINDOW, given)
  local hole = middle("openings.window", face, options)
  local list: { Shape } = {}
  if options.wall then
    table.insert(list, openings.wall(face, { hole }))
  end
  add_reveal(list, place_outline(face, hole, nil, -options.depth), options.depth)
  add_panes(list, face, hole, options)
  add_surround(list, face, hole, options)
  if options.bench > 0 then
    local x, more = (face:size().x - options.width) / 2, options.surround + 0.04
    local box = make_box(
      face,
      { x - more, x + options.width + more },
      { options.sill - 0.09, options.sill },
      { 0, options.bench }
    )
    table.insert(list, box:color(options.trim))
  end
  return list
end

-- Returns a door with reveal, frame, leaves with panels, a light above and a step: options as in DOOR.
function openings.door(face: Shape, given: any?): { Shape }
  local options = outlines.options("openings.door", DOOR, given)
  local hole = middle("openings.door", face, options)
  local list: { Shape } = {}
  if options.wall then
    table.insert(list, openings.wall(face, { hole }))
  end
  local pane = place_outline(face, hole, nil, -options.depth)
  add_reveal(list, pane, options.depth)
  add_surround(list, face, hole, options)
  local size = pane:size()
  local high = size.y - math.max(options.light, outlines.rise(options.kind, options.width))
  table.insert(list, pane:color(if high < size.y then options.glass else options.wood))
  local leaf = size.x / options.leaves
  for number = 0, options.leaves - 1 do
    local x = number * leaf
    table.insert(
      list,
      make_box(pane, { x + 0.015, x + leaf - 0.015 }, { 0.01, high }, { 0, 0.05 }):color(options.wood)
    )
    for row = 0, 1 do
      local from, to = high * (0.08 + 0.42 * row), high * (0.44 + 0.5 * row)
      local panel =
        place_outline(pane, outlines.move(outlines.rectangle(leaf * 0.64, to - from), x + leaf * 0.18, from))
      table.insert(list, panel:shift(vec(0, 0, 0.05)):extrude(0.025):color(options.wood))
    end
  end
  local inner = pane:setback(options.frame)[1]
  if inner then
    local ring = place_outline(pane, outlines.of(pane), { outlines.of(inner, pane) })
    table.insert(list, ring:extrude(0.07):color(options.wood))
  end
  if high < size.y then
    table.insert(
      list,
      make_box(pane, { 0.01, size.x - 0.01 }, { high, high + 0.09 }, { 0, 0.09 }):color(options.wood)
    )
  end
  if options.step > 0 then
    local x = (face:size().x - options.width) / 2 - options.surround
    local box = make_box(
      face,
      { x - 0.1, x + options.width + 2 * options.surround + 0.1 },
      { options.sill, options.sill + 0.12 },
      { 0, options.step }
    )
    table.insert(list, box:color(options.trim))
  end
  return list
end

-- Returns a Gothic portal: nested pointed arches, a tympanum over a lintel, two leaves, and a gable: options as in PORTAL.
function openings.portal(face: Shape, given: any?): { Shape }
  local options = outlines.options("openings.portal", PORTAL, given)
  outlines.require_slope("openings.portal", face, true)
  local size, step, orders = face:size(), options.step, options.orders
  outlines.require_room("openings.portal", "width", options.width + 2 * step * orders, size.x)
  local spring = options.height - outlines.rise("pointed", options.width)
  -- Half of the width of the gable inside and outside of its coping; its slopes touch the outermost arch.
  local widest_arch, secant = options.width + 2 * step * orders, math.sqrt(1 + STEEP * STEEP) / STEEP
  local inside = widest_arch * (secant - 0.5) + 0.02
  local outside = inside + options.gable * secant
  if options.gable > 0 then
    outlines.require_room("openings.portal", "width", 2 * outside, size.x)
    outlines.require_room("openings.portal", "height", spring + STEEP * outside, size.y)
  end
  if options.lintel >= options.height then
    error(`openings.portal: lintel is {options.lintel}: use less than the height, {options.height} m`, 2)
  end
  local function arch(order: number): { { number } }
    local more = step * order
    local width = options.width + 2 * more
    local spring = options.height - outlines.rise("pointed", options.width)
    local outline = outlines.arch("pointed", width, spring + outlines.rise("pointed", width))
    return outlines.move(outline, (size.x - width) / 2, 0)
  end
  local list: { Shape } = {}
  local widest = arch(orders)
  outlines.require_room("openings.portal", "height", place_outline(face, widest):size().y + 0.02, size.y)
  if options.wall then
    table.insert(list, openings.wall(face, { widest }))
  end
  -- From the outermost arch inwards, each one is deeper; every other one is thinner, so that shadows divide them.
  for order = orders - 1, 0, -1 do
    local deep = step * (orders - order)
    local band = outlines.band(arch(order + 1), arch(order))
    local front = if order == orders - 1
      then 0
      elseif order % 2 == 0 then -deep + step * 0.55
      else -deep + step * 0.9
    table.insert(
      list,
      place_outline(face, band, nil, -step * (orders + 1))
        :extrude(step * (orders + 1) + front)
        :color(options.trim)
    )
  end
  -- Shafts in the corners of the steps, with capitals.
  for order = 1, orders - 1 do
    local half = options.width / 2 + step * order
    for side = -1, 1, 2 do
      local profile = {
        { step * 0.42, 0 },
        { step * 0.42, 0.15 },
        { step * 0.27, 0.25 },
        { step * 0.27, spring - 0.3 },
        { step * 0.5, spring },
      }
      local at = face:position()
        + face:x_axis() * (size.x / 2 + side * half)
        + face:z_axis() * (-step * (orders - order) + step * 0.3)
      table.insert(list, turn_profile(profile, 8):translate(at):color(options.trim))
    end
  end
  local back = place_outline(face, arch(0), nil, -step * (orders + 1))
  table.insert(list, back:color(options.trim))
  local width = options.width
  table.insert(
    list,
    make_box(back, { 0, width }, { options.lintel, options.lintel + 0.3 }, { 0, 0.16 }):color(options.trim)
  )
  local foil =
    outlines.foil(width / 2, options.lintel + 0.3 + (options.height - options.lintel) * 0.34, width * 0.24, 3)
  table.insert(list, place_outline(back, outlines.circle(width / 2, foil[1][2], 0.01, 3)):color(options.trim))
  table.insert(list, place_outline(back, foil):extrude(0.06):color(options.trim))
  for leaf = 0, 1 do
    local x = width / 2 * leaf
    table.insert(
      list,
      make_box(back, { x + 0.03, x + width / 2 - 0.03 }, { 0, options.lintel }, { 0, 0.1 }):color(
        options.wood
      )
    )
    for row = 0.2, 0.8, 0.3 do
      table.insert(
        list,
        make_box(
          back,
          { x + 0.03, x + width / 2 - 0.03 },
          { options.lintel * row, options.lintel * row + 0.07 },
          { 0.1, 0.12 }
        ):color("#2b2621")
      )
    end
  end
  if options.gable > 0 then
    local x = size.x / 2
    local function corner(half: number, at: number): { number }
      return { x + half * at, spring + STEEP * half * (1 - math.abs(at)) }
    end
    local band =
      { { -outside, -1 }, { -inside, -1 }, { -inside, 0 }, { inside, 1 }, { outside, 1 }, { outside, 0 } }
    local outline: { { number } } = {}
    for at, point in band do
      outline[at] = corner(math.abs(point[1]), point[2])
    end
    table.insert(list, place_outline(face, outline):extrude(0.28):color(options.trim))
  end
  return list
end

return openings
