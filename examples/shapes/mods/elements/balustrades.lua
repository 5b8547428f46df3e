--!strict
-- Balustrades along the lower edge of an upright face: of turned balusters, of iron bars, and parapets of pierced stone.
local outlines = require("./outlines")
local balustrades = {}

-- With types, since those of required files are unknown.
local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned

local STONE = {
  height = 1,
  spacing = 0.3, -- between the middles of balusters
  radius = 0.09, -- of a baluster
  depth = 0.24, -- of rail and plinth
  pier = 0.34, -- width of the piers at both ends; 0 for none
  sides = 10,
  color = "#e2dac6",
}
local IRON = {
  height = 1.05,
  spacing = 0.12,
  bar = 0.02, -- width of a bar
  rings = false, -- a row of rings below the rail
  color = "#2a2d30",
}
local PIERCED = {
  height = 1.1,
  spacing = 0.7, -- between the middles of foils
  foils = 4,
  depth = 0.18,
  color = "#d9cfb8",
}

-- Returns the length and the height that a balustrade takes.
local function measure(owner: string, face: Shape, height: number): number
  outlines.require_slope(owner, face, true)
  outlines.require_room(owner, "height", height, face:size().y)
  return face:size().x
end

-- Returns the solid of one turned baluster with its foot at the origin.
function balustrades.baluster(height: number, radius: number, sides: number): Shape
  local shares = {
    { 0.8, 0 },
    { 0.8, 0.07 },
    { 0.5, 0.1 },
    { 0.62, 0.16 },
    { 1, 0.3 },
    { 0.92, 0.42 },
    { 0.52, 0.62 },
    { 0.42, 0.78 },
    { 0.7, 0.84 },
    { 0.45, 0.88 },
    { 0.8, 0.93 },
    { 0.8, 1 },
  }
  local profile: { { number } } = {}
  for at, share in shares do
    profile[at] = { share[1] * radius, share[2] * height }
  end
  return turn_profile(profile, sides)
end

-- Returns a balustrade of turned balusters between a plinth and a rail: options as in STONE.
function balustrades.stone(face: Shape, given: any?): { Shape }
  local options = outlines.options("balustrades.stone", STONE, given)
  local width = measure("balustrades.stone", face, options.height)
  local height, depth, pier = options.height, options.depth, options.pier
  outlines.require_room("balustrades.stone", "width", 2 * pier + 2 * options.radius, width)
  local list: { Shape } = {}
  local function add(x0: number, x1: number, y0: number, y1: number, more: number)
    local z = { -more, depth + more }
    table.insert(list, make_box(face, { x0, x1 }, { y0, y1 }, z):color(options.color))
  end
  local base, rail = height * 0.14, height * 0.15
  add(0, width, 0, base, 0)
  add(0, width, height - rail, height, 0.03)
  if pier > 0 then
    add(0, pier, base, height - rail, 0)
    add(width - pier, width, base, height - rail, 0)
  end
  local clear = width - 2 * pier
  local count = math.max(1, math.round(clear / options.spacing))
  local one = balustrades.baluster(height - base - rail, options.radius, options.sides):color(options.color)
  local corner = face:position() + face:y_axis() * base + face:z_axis() * (depth / 2)
  for number = 1, count do
    table.insert(list, one:translate(corner + face:x_axis() * (pier + clear * (number - 0.5) / count)))
  end
  return list
end

-- Returns a railing of iron bars: options as in IRON.
function balustrades.iron(face: Shape, given: any?): { Shape }
  local options = outlines.options("balustrades.iron", IRON, given)
  local width = measure("balustrades.iron", face, options.height)
  local height, bar = options.height, options.bar
  outlines.require_room("balustrades.iron", "width", 3 * bar, width)
  local list: { Shape } = {}
  local function add(x0: number, x1: number, y0: number, y1: number, depth: number)
    table.insert(list, make_box(face, { x0, x1 }, { y0, y1 }, { 0, depth }):color(options.color))
  end
  add(0, width, height - 0.05, height, bar * 2.5)
  add(0, width, 0.08, 0.08 + bar * 1.5, bar * 1.5)
  local top = height - 0.05
  if options.rings then
    top -= options.spacing
    add(0, width, top - bar, top, bar)
  end
  local count = math.max(1, math.round((width - bar) / options.spacing))
  for number = 0, count do
    local x = (width - bar) * number / count
    add(x, x + bar, 0.08, top, bar)
    if options.rings and number < count then
      local radius = (width - bar) / count / 2
      local y = top + options.spacing / 2
      local ring = place_outline(
        face,
        outlines.circle(x + bar / 2 + radius, y, options.spacing / 2, 12),
        { outlines.circle(x + bar / 2 + radius, y, options.spacing / 2 - bar, 12) }
      )
      table.insert(list, ring:extrude(bar):color(options.color))
    end
  end
  return list
end

-- Returns a parapet of stone that is pierced by foils, with a coping: options as in PIERCED.
function balustrades.pierced(face: Shape, given: any?): { Shape }
  local options = outlines.options("balustrades.pierced", PIERCED, given)
  local width = measure("balustrades.pierced", face, options.height)
  local height, depth = options.height, options.depth
  local count = math.max(1, math.floor(width / options.spacing))
  local step = width / count
  local radius = math.min(step, height * 0.8) * 0.44
  outlines.require_room("balustrades.pierced", "width", 0.2, width)
  local holes: { any } = {}
  for number = 1, count do
    holes[number] = outlines.foil(step * (number - 0.5), height * 0.46, radius, options.foils)
  end
  local plate = place_outline(face, outlines.rectangle(width, height * 0.92), holes)
  return {
    plate:extrude(depth):color(options.color),
    make_box(face, { 0, width }, { height * 0.92, height }, { -0.04, depth + 0.04 }):color(options.color),
  }
end

return balustrades
