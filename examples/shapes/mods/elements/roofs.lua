--!strict
-- Parts of roofs: dormers, chimneys, spires and turrets.
local openings = require("./openings")
local outlines = require("./outlines")
local roofs = {}

-- With types, since those of required files are unknown.
local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local sweep_across: (face: Shape, profile: any, x: number, width: number) -> Shape = outlines.across
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned
local make_face: (corners: { any }) -> Shape = outlines.face

local DORMER = {
  kind = "gable", -- "gable", "hip", "shed" or "eyebrow"
  width = 1.4,
  height = 1.5, -- of the front wall
  depth = 2.5, -- from the front backwards, into the roof
  roof = 0.7, -- height of the roof
  overhang = 0.14,
  window = { width = 0.9, height = 1.1, sill = 0.2, surround = 0.06, bench = 0.05, depth = 0.1 },
  wall = "#d8cbb0",
  tiles = "#6f4a3f",
}
local CHIMNEY = {
  height = 2,
  cap = 0.12, -- height of the cap
  pots = 3,
  wall = "#9a6a52",
  color = "#c9895f",
}
local SPIRE = {
  height = 18,
  sides = 8, -- 4 for a pyramid, 8 for an octagon on broaches
  lucarnes = 1, -- rows of small gabled windows on the four main sides
  overhang = 0.2,
  cross = 1.2, -- height of the cross; 0 for none
  tiles = "#5d656d",
  color = "#3a3d40",
}
local TURRET = {
  radius = 1.1,
  height = 3.2, -- of the walls
  corbel = 1.4, -- height of the corbel below the walls; 0 for none
  roof = 3,
  sides = 16,
  windows = 3,
  wall = "#d8cbb0",
  tiles = "#5d656d",
}

local KINDS = { "gable", "hip", "shed", "eyebrow" }

-- Returns a dormer whose front stands on the lower edge of an upright face, in its middle: options as in DORMER.
function roofs.dormer(face: Shape, given: any?): { Shape }
  local options = outlines.options("roofs.dormer", DORMER, given)
  outlines.require_slope("roofs.dormer", face, true)
  local size, width, height, depth = face:size(), options.width, options.height, options.depth
  local kind: string = options.kind
  outlines.require_room("roofs.dormer", "width", width, size.x)
  if not table.find(KINDS, kind) then
    error(`roofs.dormer: unknown kind {tostring(kind)}: use {table.concat(KINDS, ", ")}`, 2)
  end
  local x0, over, rise = (size.x - width) / 2, options.overhang, options.roof
  local list: { Shape } = {}
  local function prism(points: { { number } }, z0: number, z1: number, color: string)
    table.insert(
      list,
      place_outline(face, outlines.move(points, x0, 0), nil, z0):extrude(z1 - z0):color(color)
    )
  end
  if kind == "eyebrow" then
    -- A low curve that fades into the roof at both sides.
    local lower: { any }, upper: { any } = {}, {}
    for step = 0, 20 do
      local t = step / 20
      local y = height * (0.5 - 0.5 * math.cos(2 * math.pi * t)) * 0.9
      table.insert(lower, { width * t, y })
      table.insert(upper, { width * t, y + 0.12 })
    end
    local window: { any } = { { width * 0.26, 0.02 }, { width * 0.74, 0.02 } }
    for step = 14, 6, -1 do
      table.insert(window, { lower[step + 1][1], lower[step + 1][2] - 0.14 })
    end
    local shell: { any } = {}
    for at = 1, 21 do
      table.insert(shell, lower[at])
    end
    for at = 21, 1, -1 do
      table.insert(shell, upper[at])
    end
    prism(shell, -depth, over, options.tiles)
    local front: { any } = {}
    for at = 21, 1, -1 do
      table.insert(front, { lower[at][1], lower[at][2] + 0.01 })
    end
    prism(front, -depth, -0.16, options.wall)
    local pane = place_outline(face, outlines.move(window, x0, 0), nil, -0.14)
    table.insert(list, pane:color("#3a4956"))
    local inner = pane:setback(0.06)[1]
    if inner then
      table.insert(
        list,
        place_outline(pane, outlines.of(pane), { outlines.of(inner, pane) }):extrude(0.07):color("#e9e6df")
      )
    end
    return list
  end
  -- The front wall and the cheeks.
  local wall = place_outline(face, outlines.move(outlines.rectangle(width, height), x0, 0))
  local parts = openings.window(wall, options.window)
  parts[1] = parts[1]:color(options.wall)
  outlines.add(list, parts)
  local cheeks = wall:extrude(-depth)
  for _, side in cheeks:faces("tag:extrude.side") do
    table.insert(list, side:color(options.wall))
  end
  if kind == "gable" then
    local slope = rise / (width / 2)
    prism({ { 0, height }, { width, height }, { width / 2, height + rise } }, -depth, 0, options.wall)
    local drop = over * slope
    local thick = 0.1 * math.sqrt(1 + slope * slope)
    prism({
      { -over, height - drop },
      { width / 2, height + rise },
      { width + over, height - drop },
      { width + over, height - drop + thick },
      { width / 2, height + rise + thick },
      { -over, height - drop + thick },
    }, -depth, over, options.tiles)
  elseif kind == "shed" then
    -- The roof rises backwards.
    local profile = {
      { over, height - 0.02 },
      { over, height + 0.1 },
      { -depth, height + rise + 0.1 },
      { -depth, height - 0.02 },
    }
    table.insert(list, sweep_across(face, profile, x0 - over, width + 2 * over):color(options.tiles))
  else
    local half, back = width / 2 + over, -depth
    local corner = face:position() + face:x_axis() * (size.x / 2)
    local function at(x: number, y: number, z: number): any
      return corner + face:x_axis() * x + face:y_axis() * y + face:z_axis() * z
    end
    local ridge = over - half
    local points = {
      at(-half, height, over),
      at(half, height, over),
      at(half, height, back),
      at(-half, height, back),
      at(0, height + rise, ridge),
      at(0, height + rise, back),
    }
    local faces = { { 1, 2, 5 }, { 2, 3, 6, 5 }, { 3, 4, 6 }, { 4, 1, 5, 6 }, { 4, 3, 2, 1 } }
    table.insert(list, shape({ points = points, faces = faces }):color(options.tiles))
  end
  return list
end

-- Returns a chimney on a horizontal face, with a cap and pots along its longer side: options as in CHIMNEY.
function roofs.chimney(face: Shape, given: any?): { Shape }
  local options = outlines.options("roofs.chimney", CHIMNEY, given)
  outlines.require_slope("roofs.chimney", face, false)
  local size, height, cap = face:size(), options.height, options.cap
  outlines.require_room("roofs.chimney", "cap", cap, height)
  local list = { face:extrude(height - cap):color(options.wall) }
  local ledge = face:offset(0.06)[1]:translate(vec(0, 0, height - cap))
  table.insert(list, ledge:extrude(cap):color(options.wall))
  local along = if size.x > size.y then face:x_axis() else face:y_axis()
  local long, short = math.max(size.x, size.y), math.min(size.x, size.y)
  local radius = math.min(short * 0.3, 0.13)
  local profile = {
    { radius, 0 },
    { radius * 0.8, 0.35 },
    { radius * 1.05, 0.38 },
    { radius * 1.05, 0.46 },
    { radius * 0.7, 0.46 },
  }
  for number = 1, options.pots do
    local at = face:center() + along * (long * ((number - 0.5) / options.pots - 0.5)) + vec(0, 0, height)
    table.insert(list, turn_profile(profile, 10):translate(at):color(options.color))
  end
  return list
end

-- Returns a spire over a horizontal face, a square: options as in SPIRE.
function roofs.spire(face: Shape, given: any?): { Shape }
  local options = outlines.options("roofs.spire", SPIRE, given)
  outlines.require_slope("roofs.spire", face, false)
  if options.sides ~= 4 and options.sides ~= 8 then
    error(`roofs.spire: sides is {options.sides}: use 4 or 8`, 2)
  end
  local size, height, middle = face:size(), options.height, face:center()
  local half = math.min(size.x, size.y) / 2 + options.overhang
  local x, y = face:x_axis(), face:y_axis()
  local list: { Shape } = {}
  local function corners(radius: number, sides: number, z: number): { any }
    local points: { any } = {}
    for number = 0, sides - 1 do
      local angle = 2 * math.pi * (number + 0.5) / sides
      local far = radius / math.cos(math.pi / sides)
      table.insert(points, middle + x * (far * math.cos(angle)) + y * (far * math.sin(angle)) + vec(0, 0, z))
    end
    return points
  end
  local function pyramid(points: { any }, top: any)
    local faces: { any }, bottom: { number } = {}, {}
    local count = #points
    for number = 1, count do
      table.insert(faces, { number, number % count + 1, count + 1 })
      table.insert(bottom, 1, number)
    end
    table.insert(faces, bottom)
    table.insert(points, top)
    table.insert(list, shape({ points = points, faces = faces }):color(options.tiles))
  end
  local top = middle + vec(0, 0, height)
  if options.sides == 8 then
    -- Broaches: a low pyramid fills the corners of the square below the octagon.
    pyramid(corners(half, 4, 0), middle + vec(0, 0, math.min(height * 0.42, half * 2.6)))
  end
  pyramid(corners(half, options.sides, 0), top)
  for row = 1, options.lucarnes do
    local t = 0.1 + 0.3 * (row - 1)
    local wide = half * (0.5 - 0.16 * row)
    local tall = wide * 2.6
    for side = 0, 3 do
      local angle = math.pi / 2 * side
      local out = x * math.cos(angle) + y * math.sin(angle)
      local aside = y * math.cos(angle) - x * math.sin(angle)
      local front = half * (1 - t) + 0.12
      local low = middle + out * front + vec(0, 0, height * t)
      local points = {
        low - aside * (wide / 2),
        low + aside * (wide / 2),
        low + aside * (wide / 2) + vec(0, 0, tall),
        low - aside * (wide / 2) + vec(0, 0, tall),
      }
      local front_face = make_face(points)
      outlines.add(
        list,
        roofs.dormer(front_face, {
          width = wide,
          height = tall * 0.62,
          depth = half * 0.6,
          roof = wide * 0.9,
          overhang = wide * 0.1,
          wall = "#b9ad95",
          tiles = options.tiles,
          window = {
            kind = "pointed",
            width = wide * 0.5,
            height = tall * 0.48,
            sill = tall * 0.08,
            surround = 0,
            bench = 0,
            depth = 0.08,
            frame = 0.04,
            columns = 1,
            rows = 1,
            glass = "#23282d",
          },
        })
      )
    end
  end
  if options.cross > 0 then
    local c = options.cross
    for _, bar in { { 0.09, 0.09, c }, { c * 0.5, 0.09, 0.09 } } do
      local low = if bar[1] > 0.1 then c * 0.62 else -0.4
      local box = cuboid(bar[1], bar[2], bar[3] - math.min(low, 0))
      table.insert(list, box:translate(top + vec(-bar[1] / 2, -bar[2] / 2, low)):color(options.color))
    end
  end
  return list
end

-- Returns a round turret before the middle of an upright face, with a corbel, small windows and a conical roof; its corbel ends at
-- the lower edge: options as in TURRET.
function roofs.turret(face: Shape, given: any?): { Shape }
  local options = outlines.options("roofs.turret", TURRET, given)
  outlines.require_slope("roofs.turret", face, true)
  local size, r = face:size(), options.radius
  outlines.require_room("roofs.turret", "diameter", 2 * r, size.x)
  local foot = face:position() + face:x_axis() * (size.x / 2)
  local low, high = options.corbel, options.corbel + options.height
  local list: { Shape } = {}
  local wall: { any } = {}
  if low > 0 then
    for step = 0, 4 do
      local t = step / 4
      table.insert(wall, { r * (0.08 + 0.86 * math.sin(t * math.pi / 2)), low * t * 0.9 })
      table.insert(wall, { r * (0.14 + 0.9 * math.sin(t * math.pi / 2)), low * (t * 0.9 + 0.06) })
    end
  end
  table.insert(wall, { r, low })
  table.insert(wall, { r, high - 0.3 })
  table.insert(wall, { r * 1.12, high - 0.15 })
  table.insert(wall, { r * 1.12, high })
  table.insert(list, turn_profile(wall, options.sides):translate(foot):color(options.wall))
  local roof =
    { { r * 1.22, high - 0.02 }, { r * 0.96, high + options.roof * 0.16 }, { 0, high + options.roof } }
  table.insert(list, turn_profile(roof, options.sides):translate(foot):color(options.tiles))
  for number = 1, options.windows do
    local angle = math.pi * number / (options.windows + 1)
    local out = face:x_axis() * -math.cos(angle) + face:z_axis() * math.sin(angle)
    local aside = face:x_axis() * math.sin(angle) + face:z_axis() * math.cos(angle)
    local at = foot
      + out * (r * math.cos(math.pi / options.sides) + 0.03)
      + vec(0, 0, low + options.height * 0.3)
    local wide, tall = r * 0.3, options.height * 0.38
    local points = {
      at - aside * (wide / 2),
      at + aside * (wide / 2),
      at + aside * (wide / 2) + vec(0, 0, tall),
      at - aside * (wide / 2) + vec(0, 0, tall),
    }
    local pane = make_face(points)
    table.insert(list, pane:extrude(-0.3):color("#3a4956"))
    local ring = place_outline(
      pane,
      { { -0.08, -0.08 }, { wide + 0.08, -0.08 }, { wide + 0.08, tall + 0.08 }, { -0.08, tall + 0.08 } },
      { outlines.rectangle(wide, tall) }
    )
    table.insert(list, ring:extrude(0.06):color("#e4dccb"))
  end
  return list
end

return roofs
