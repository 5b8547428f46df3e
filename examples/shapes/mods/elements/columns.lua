--!strict
-- Columns and pilasters. A column takes a horizontal face, its foot, and stands in the middle of it; pilasters and half columns
-- take an upright face and stand in front of it.
local outlines = require("./outlines")
local columns = {}

-- With types, since those of required files are unknown.
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned

local COLUMN = {
  order = "tuscan", -- "tuscan", "doric" or "ionic"
  height = 4,
  radius = 0.25, -- of the shaft at its foot
  sides = 20, -- of the shaft; every other corner of a fluted shaft is cut
  flute = 0, -- depth of the flutes as a share of the radius; 0 for none
  entasis = 0.16, -- share of the radius that the shaft loses towards the top
  color = "#e2dac6",
}
local PILASTER = {
  width = 0.5,
  height = 4,
  depth = 0.12,
  color = "#e2dac6",
}

local ORDERS = { "tuscan", "doric", "ionic" }

-- Returns the profile of a column from its base to the necking below the capital.
local function profile_of(order: string, height: number, r: number, entasis: number): { { number } }
  local profile: { { number } } = {}
  local function add(radius: number, z: number)
    table.insert(profile, { radius * r, z })
  end
  local foot = 0
  if order ~= "doric" then
    -- A torus, and for the Ionic base a hollow and a second torus.
    local function torus(radius: number, high: number)
      for step = 0, 4 do
        local angle = -math.pi / 2 + math.pi * step / 4
        add(radius - high / 2 + high / 2 * math.cos(angle), foot + r * high * (0.5 + 0.5 * math.sin(angle)))
      end
      foot += r * high
    end
    torus(1.36, 0.3)
    if order == "ionic" then
      add(1.14, foot + r * 0.05)
      add(1.1, foot + r * 0.16)
      foot += r * 0.22
      torus(1.25, 0.2)
    end
    add(1.08, foot + r * 0.02)
    add(1.08, foot + r * 0.1)
    foot += r * 0.1
  end
  local top = height - r * (if order == "doric" then 0.85 else 0.75)
  for step = 0, 8 do
    local t = step / 8
    add(1 - entasis * t ^ 1.7, lerp(foot, top, t))
  end
  local narrow = 1 - entasis
  if order == "doric" then
    add(narrow * 1.04, top + r * 0.05)
    add(1.1, top + r * 0.25)
    add(1.27, top + r * 0.4)
    add(1.27, top + r * 0.45)
  else
    add(narrow * 1.1, top + r * 0.03)
    add(narrow * 1.1, top + r * 0.1)
    add(narrow, top + r * 0.12)
    add(narrow, top + r * 0.32)
    add(1.12, top + r * 0.5)
    add(1.12, top + r * 0.52)
  end
  return profile
end

-- Returns a column of an order with base, shaft and capital: options as in COLUMN.
function columns.column(face: Shape, given: any?): { Shape }
  local options = outlines.options("columns.column", COLUMN, given)
  local r, height = options.radius, options.height
  local order: string = options.order
  outlines.require_slope("columns.column", face, false)
  if not table.find(ORDERS, order) then
    error(`columns.column: unknown order {tostring(order)}: use {table.concat(ORDERS, ", ")}`, 2)
  end
  local size = face:size()
  outlines.require_room("columns.column", "base", 2 * r, math.min(size.x, size.y))
  if height < 6 * r then
    error(
      `columns.column: height is {height}: use at least 6 times the radius, {math.ceil(600 * r) / 100} m`,
      2
    )
  end
  local foot = face:position() + face:x_axis() * (size.x / 2) + face:y_axis() * (size.y / 2)
  local function block(half: number, low: number, high: number): Shape
    return cuboid(2 * half, 2 * half, high - low):translate(foot + vec(-half, -half, low))
  end
  local list: { Shape } = {}
  local base = if order == "doric" then 0 else r * 0.28
  if base > 0 then
    table.insert(list, block(r * 1.38, 0, base))
  end
  local profile = profile_of(order, height - base, r, options.entasis)
  -- Only the shaft has flutes, so bases and capitals are solids of their own.
  local shaft: { { number } }, from, to = {}, 0, 0
  for at, point in profile do
    if at == #profile - (if order == "doric" then 12 else 14) then
      from = at
    end
  end
  to = from + 8
  for at = from, to do
    table.insert(shaft, profile[at])
  end
  table.insert(list, turn_profile(shaft, options.sides, options.flute):translate(foot + vec(0, 0, base)))
  local lower: { { number } }, upper: { { number } } = {}, {}
  for at, point in profile do
    if at < from then
      table.insert(lower, point)
    elseif at >= to then
      table.insert(upper, point)
    end
  end
  if #lower > 1 then
    table.insert(list, turn_profile(lower, 20):translate(foot + vec(0, 0, base)))
  end
  table.insert(list, turn_profile(upper, 20):translate(foot + vec(0, 0, base)))
  local cap = upper[#upper][2] + base
  if order == "ionic" then
    -- Volutes: two scrolls at either side of the echinus, along y.
    for side = -1, 1, 2 do
      local scroll = cylinder(r * 0.46, 2 * r, 20):rotate(90, vec(1, 0, 0))
      local middle = scroll:center()
      table.insert(list, scroll:translate(foot + vec(side * r * 1.05, 0, cap - r * 0.28) - middle))
      local eye = cylinder(r * 0.15, 2.14 * r, 10):rotate(90, vec(1, 0, 0))
      table.insert(list, eye:translate(foot + vec(side * r * 1.05, 0, cap - r * 0.28) - eye:center()))
    end
    local band = cuboid(2.1 * r, 1.9 * r, r * 0.34)
    table.insert(list, band:translate(foot + vec(-1.05 * r, -0.95 * r, cap - r * 0.16)))
    table.insert(list, block(r * 1.2, cap + r * 0.1, height))
  else
    table.insert(list, block(r * 1.34, cap, height))
  end
  for at, part in list do
    list[at] = part:color(options.color)
  end
  return list
end

-- Returns a flat pilaster in the middle of an upright face, with base and capital: options as in PILASTER.
function columns.pilaster(face: Shape, given: any?): { Shape }
  local options = outlines.options("columns.pilaster", PILASTER, given)
  local width, height, depth = options.width, options.height, options.depth
  outlines.require_slope("columns.pilaster", face, true)
  local size = face:size()
  outlines.require_room("columns.pilaster", "width", width, size.x)
  outlines.require_room("columns.pilaster", "height", height, size.y)
  local list: { Shape } = {}
  local function add(more: number, low: number, high: number)
    local half = width / 2 + more
    local x = { size.x / 2 - half, size.x / 2 + half }
    table.insert(list, make_box(face, x, { low, high }, { 0, depth + more }):color(options.color))
  end
  local unit = width / 4
  add(unit * 0.35, 0, unit)
  add(unit * 0.18, unit, unit * 1.35)
  add(0, unit * 1.35, height - unit * 1.5)
  add(unit * 0.12, height - unit * 1.5, height - unit * 1.3)
  add(0, height - unit * 1.3, height - unit * 0.8)
  add(unit * 0.22, height - unit * 0.8, height - unit * 0.45)
  add(unit * 0.42, height - unit * 0.45, height)
  return list
end

-- Returns half a column before the middle of an upright face: options as of `columns.column`.
function columns.half_column(face: Shape, given: any?): { Shape }
  local options = outlines.options("columns.half_column", COLUMN, given)
  outlines.require_slope("columns.half_column", face, true)
  local size = face:size()
  outlines.require_room("columns.half_column", "width", 2.8 * options.radius, size.x)
  outlines.require_room("columns.half_column", "height", options.height, size.y)
  local middle = face:position() + face:x_axis() * (size.x / 2)
  local side = 3 * options.radius
  local foot = rectangle(side, side):translate(middle - vec(side / 2, side / 2, 0))
  local list: { Shape } = {}
  for _, part in columns.column(foot, options) do
    -- The half in front of the face; its cut closes it.
    local half = part:trim(middle, -face:z_axis())
    if half then
      table.insert(list, half)
    end
  end
  return list
end

return columns
