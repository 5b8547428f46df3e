--!strict
-- Rooms in front of a wall and behind it: bay windows, oriels, balconies and loggias. Each function takes an upright face, a
-- wall with room for the element, and returns what stands in front of it or behind it.
local balustrades = require("./balustrades")
local openings = require("./openings")
local outlines = require("./outlines")
local bays = {}

-- With types, since those of required files are unknown.
local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local sweep_across: (face: Shape, profile: any, x: number, width: number) -> Shape = outlines.across
local make_face: (corners: { any }) -> Shape = outlines.face

local BAY = {
  width = 3,
  height = 3, -- of the walls
  depth = 0.9,
  cant = 0.7, -- how far the sides lean in, along the wall; 0 for a rectangular bay
  sill = 0, -- height of the lower side above the lower edge
  roof = 0.7, -- height of the roof
  corbel = 0, -- height of the corbel below; 0 for a bay that stands on the ground
  windows = { height = 1.6, sill = 0.8, width = 0.8 }, -- options of `openings.window`; widths are reduced to fit
  wall = "#d8cbb0",
  tiles = "#7a4a3c",
}
local BALCONY = {
  width = 2.4,
  sill = 0, -- height of the slab above the lower edge
  depth = 1,
  slab = 0.16,
  railing = "iron", -- "iron" or "stone"
  height = 1, -- of the railing
  brackets = 2,
  color = "#e2dac6",
}
local LOGGIA = {
  depth = 1.6,
  height = 1.05, -- of the railing
  railing = "iron",
  window = { width = 1.8, height = 2.1, sill = 0, columns = 3, rows = 1, bench = 0, surround = 0 },
  inside = "#cfc4ae",
}

-- Returns the plan of a bay as points from left to right in x and z of the wall.
local function bay_plan(options: any, x: number): { { number } }
  local cant = math.min(options.cant, options.width / 2 - 0.3)
  return {
    { x, 0 },
    { x + cant, options.depth },
    { x + options.width - cant, options.depth },
    { x + options.width, 0 },
  }
end

-- Returns a bay of three canted walls with windows and a roof; with a corbel, an oriel: options as in BAY.
function bays.bay(face: Shape, given: any?): { Shape }
  local options = outlines.options("bays.bay", BAY, given)
  outlines.require_slope("bays.bay", face, true)
  local size, corner = face:size(), face:position()
  outlines.require_room("bays.bay", "width", options.width, size.x)
  outlines.require_room("bays.bay", "height", options.sill + options.height + options.roof, size.y)
  outlines.require_room("bays.bay", "corbel", options.corbel, if options.corbel > 0 then options.sill else 0)
  local plan = bay_plan(options, (size.x - options.width) / 2)
  local function at(point: { number }, up: number, scale: number?): any
    local s = scale or 1
    local x = size.x / 2 + (point[1] - size.x / 2) * s
    return corner + face:x_axis() * x + face:z_axis() * (point[2] * s) + face:y_axis() * up
  end
  -- The solid between two heights, whose plan is scaled at the lower and at the upper end.
  local function body(low: number, high: number, lower: number, upper: number): Shape
    local points: { any } = {}
    for _, end_of in { { low, lower }, { high, upper } } do
      for _, point in plan do
        table.insert(points, at(point, end_of[1], end_of[2]))
      end
    end
    local faces: { any } = { { 1, 4, 3, 2 }, { 5, 6, 7, 8 } }
    for side = 1, 4 do
      local next = side % 4 + 1
      table.insert(faces, { next, next + 4, side + 4, side })
    end
    return shape({ points = points, faces = faces })
  end
  local low, high = options.sill, options.sill + options.height
  local list: { Shape } = {}
  for side = 1, 3 do
    local a, b = plan[side], plan[side + 1]
    local wall = make_face({ at(a, low), at(b, low), at(b, high), at(a, high) })
    local window: { [string]: any } = {}
    for name, value in options.windows :: any do
      window[name] = value
    end
    window.width = math.min(window.width or 1.2, wall:size().x - 0.36)
    if window.width < 0.3 then
      table.insert(list, wall:color(options.wall))
      continue
    end
    window.surround = math.min(window.surround or 0.08, 0.08)
    local parts = openings.window(wall, window)
    parts[1] = parts[1]:color(options.wall)
    outlines.add(list, parts)
  end
  table.insert(list, body(high, high + 0.14, 1.05, 1.05):color("#e2dac6"))
  if options.roof > 0.15 then
    table.insert(list, body(high + 0.14, high + options.roof, 1.03, 0.12):color(options.tiles))
  end
  if options.corbel > 0 then
    table.insert(list, body(low - options.corbel, low - 0.12, 0.15, 0.96):color(options.wall))
    table.insert(list, body(low - 0.12, low, 1.03, 1.03):color("#e2dac6"))
  else
    table.insert(list, body(low, low + 0.3, 1.03, 1.03):color("#e2dac6"))
  end
  return list
end

-- Adds a railing along the front and both sides of a slab before a wall.
local function add_railing(
  list: { Shape },
  face: Shape,
  x: { number },
  y: number,
  depth: number,
  options: any
)
  local make = if options.railing == "stone" then balustrades.stone else balustrades.iron
  local settings: any = { height = options.height }
  if options.railing == "stone" then
    settings.pier = 0.2
    settings.depth = 0.18
    settings.radius = 0.07
  end
  local thick = if options.railing == "stone" then 0.2 else 0.06
  local front = place_outline(face, outlines.move(outlines.rectangle(x[2] - x[1], options.height), x[1], y))
  outlines.add(list, make(front:shift(vec(0, 0, depth - thick)), settings))
  if options.railing == "stone" and depth < 1 then
    return
  end
  for side = 1, 2 do
    local right = side == 2
    local edge = face:position() + face:x_axis() * x[side] + face:y_axis() * y
    local out, up = face:z_axis() * (depth - thick), face:y_axis() * options.height
    local inwards = face:x_axis() * (if right then -thick else thick)
    local a, b = edge + inwards, edge + inwards + out
    local ring = if right then { b, a, a + up, b + up } else { a, b, b + up, a + up }
    outlines.add(list, make(make_face(ring), settings))
  end
end

-- Returns a balcony: a slab on brackets with a railing: options as in BALCONY.
function bays.balcony(face: Shape, given: any?): { Shape }
  local options = outlines.options("bays.balcony", BALCONY, given)
  outlines.require_slope("bays.balcony", face, true)
  local size, slab = face:size(), options.slab
  outlines.require_room("bays.balcony", "width", options.width, size.x)
  outlines.require_room("bays.balcony", "height", options.sill + slab + options.height, size.y)
  if options.railing ~= "iron" and options.railing ~= "stone" then
    error(`bays.balcony: unknown railing {tostring(options.railing)}: use iron or stone`, 2)
  end
  local x0 = (size.x - options.width) / 2
  local x = { x0, x0 + options.width }
  local list = {
    make_box(face, x, { options.sill, options.sill + slab }, { 0, options.depth }):color(options.color),
  }
  local d, h = options.depth * 0.75, 0.5
  for number = 1, options.brackets do
    local low = options.sill - h
    local profile = {
      { 0, low },
      { d * 0.2, low },
      { d * 0.36, low + h * 0.45 },
      { d, low + h * 0.72 },
      { d, low + h },
      { 0, low + h },
    }
    local at = x0
      + options.width
        * (if options.brackets == 1 then 0.5 else 0.1 + 0.8 * (number - 1) / (options.brackets - 1))
    table.insert(list, sweep_across(face, profile, at - 0.09, 0.18):color(options.color))
  end
  add_railing(list, face, x, options.sill + slab, options.depth, options)
  return list
end

-- Returns an open room behind the whole face: floor, ceiling and sides, a back with a window, and a railing: options as in
-- LOGGIA.
function bays.loggia(face: Shape, given: any?): { Shape }
  local options = outlines.options("bays.loggia", LOGGIA, given)
  outlines.require_slope("bays.loggia", face, true)
  local size = face:size()
  local back = place_outline(face, outlines.rectangle(size.x, size.y), nil, -options.depth)
  local room = back:extrude(options.depth):joined_faces("tag:extrude.side")
  local list: { Shape } = {}
  if room then
    table.insert(list, room:reverse():color(options.inside))
  end
  local parts = openings.window(back, options.window)
  parts[1] = parts[1]:color(options.inside)
  outlines.add(list, parts)
  local make = if options.railing == "stone" then balustrades.stone else balustrades.iron
  outlines.add(list, make(back:shift(vec(0, 0, options.depth - 0.1)), { height = options.height }))
  return list
end

return bays
