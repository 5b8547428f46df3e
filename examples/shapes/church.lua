--!strict
-- A Gothic parish church: nave, aisles and clerestory, flying buttresses, a polygonal apse, a west front and a tower. Bays and
-- supports are models of the package in mods/elements, made once and placed many times.
local elements = require("@elements")
local outlines, tracery, openings = elements.outlines, elements.tracery, elements.openings
local supports, roofs, cornices, balustrades =
  elements.supports, elements.roofs, elements.cornices, elements.balustrades

local bays = param("bays", { default = 6, min = 3, max = 12, step = 1, doc = "Number of bays of the nave." })
local width =
  param("width", { default = 9, min = 7, max = 13, unit = "m", doc = "Width of the nave between its walls." })
local tower = param(
  "tower",
  { default = 27, min = 20, max = 40, unit = "m", doc = "Height of the tower without its spire." }
)
local steepness =
  param("steepness", { default = 60, min = 45, max = 68, unit = "deg", doc = "Slope of the roof." })

local STONE, TRIM, SLATE, LAWN = "#d3c7ab", "#ddd2ba", "#5a636d", "#7d8b5a"
local BAY, AISLE, LOW, LEAN, HIGH = 5, width / 2, 7.6, 11.2, 17.5
local length, half = bays * BAY, width / 2
local rise = half * math.tan(math.rad(steepness))
local side = math.min(6.4, BAY + 1.4)

local At = module("At", "model", "place", "out")
local Church, Flank, Apse, West, Tower, Roofs =
  module("Church"), module("Flank", "sign"), module("Apse"), module("West"), module("Tower"), module("Roofs")

-- The front of a box at the origin: every model is made on it, and `At` turns it to another wall.
local function wall(wide: number, high: number): Shape
  return cuboid(wide, 1, high):faces("front")[1]
end
local function model(...: { Shape }): Derived
  local list: { any } = {}
  for _, shapes in { ... } do
    for _, part in shapes do
      table.insert(list, Draw(part))
    end
  end
  local system = lsystem({ object = extruder({ color = STONE }) })
  system:axiom(sequence(list))
  return system:derive()
end
-- A band along a wall at a height.
local function band(face: Shape, up: number, high: number, depth: number): Shape
  local profile =
    { { -0.02, up }, { depth, up + high * 0.3 }, { depth, up + high * 0.7 }, { -0.02, up + high } }
  return outlines.across(face, profile, 0, face:size().x):color(TRIM)
end

local aisle_wall, clerestory_wall = wall(BAY, LOW), wall(BAY, HIGH - LEAN)
local aisle = model(
  tracery.window(aisle_wall, { width = 2.5, height = 4.6, sill = 1.9, bar = 0.15 }),
  { band(aisle_wall, 1.5, 0.22, 0.16), band(aisle_wall, LOW - 0.35, 0.4, 0.3) },
  {
    outlines
      .across(aisle_wall, { { -0.05, 0 }, { 0.22, 0 }, { 0.22, 0.5 }, { 0, 0.66 } }, 0, BAY)
      :color(TRIM),
  },
  balustrades.pierced(wall(BAY, 2):translate(vec(0, -0.1, LOW)), { spacing = 0.9 })
)
local clerestory = model(
  tracery.window(clerestory_wall, { width = 2.8, height = HIGH - LEAN - 1.3, sill = 0.6, bar = 0.16 }),
  { band(clerestory_wall, HIGH - LEAN - 0.5, 0.5, 0.4) }
)
-- A buttress with a pier and a pinnacle above, and the flying buttress from it to the nave.
local foot = wall(1, LOW + 6):translate(vec(-0.5, 0, 0))
local pier = outlines.box(foot, { 0.12, 0.88 }, { LOW - 1, LEAN + 0.6 }, { 0, 1 })
local support = model(
  supports.buttress(foot, { width = 0.9, height = LOW + 1.6, depth = 1.9, top = 0.6, stages = 2 }),
  { pier },
  supports.pinnacle(pier:faces("up")[1], { height = 4.6 }),
  supports.flyer(wall(1, HIGH):translate(vec(-0.5, AISLE, 0)), {
    reach = AISLE,
    foot = LOW + 1.2,
    head = HIGH - 1.8,
    drop = HIGH - LEAN - 2.2,
    height = 0.8,
    width = 0.55,
  })
)
local corner_support = model(
  supports.buttress(
    wall(1, HIGH):translate(vec(-0.5, 0, 0)),
    { width = 1, height = HIGH - 1, depth = 1.5, stages = 3 }
  )
)
local apse_side = 2 * half * math.sin(math.pi / 10)
local apse_wall = wall(apse_side, HIGH)
local apse = model(
  tracery.window(apse_wall, { width = apse_side - 1.1, height = 11, sill = 4, bar = 0.12, foils = 4 }),
  { band(apse_wall, 3.5, 0.24, 0.16), band(apse_wall, HIGH - 0.5, 0.5, 0.4) },
  {
    outlines
      .across(apse_wall, { { -0.05, 0 }, { 0.25, 0 }, { 0.25, 0.7 }, { 0, 0.9 } }, 0, apse_side)
      :color(TRIM),
  }
)

local church = lsystem({ object = extruder({ color = STONE }) })
church:axiom(Church())
church:rule("Church()", function(this)
  -- The ground: a lawn, a square, a path, and a low wall around the churchyard on the right.
  local parts: { any } = {}
  local function add(part: Shape, color: string)
    table.insert(parts, Draw(part:color(color)))
  end
  add(disk(160, 64):translate(vec(0, 0, -0.3)):extrude(0.3), LAWN)
  add(rectangle(width + 34, 60):translate(vec(-width - 18, -60.5, 0)):extrude(0.04), "#b9ae98")
  add(rectangle(2.2, length + 30):translate(vec(half + AISLE + 3.4, -4, 0)):extrude(0.03), "#b9ae98")
  local yard = rectangle(width + 20, length + 26):translate(vec(half + AISLE + 1.4, -3, 0))
  for _, edge in yard:border({ 0.45, 0.45, 0.45, 0.45 }) do
    local at = edge:center()
    if edge:z_axis().z > 0 and at.x > half + AISLE + 2 then
      add(edge:extrude(1.2), "#c4b898")
      add(edge:translate(vec(0, 0, 1.2)):offset(0.06)[1]:extrude(0.14), TRIM)
    end
  end
  for row = 0, 2 do
    for number = 0, math.floor(length / 2.6) do
      if random() < 0.8 then
        local wide, high = random(0.45, 0.75), random(0.7, 1.3)
        local kind = if random() < 0.5 then "round" else "segmental"
        local stone = wall(wide, 2):translate(vec(half + AISLE + 8.5 + 4 * row, 2 + 2.6 * number, 0))
        local slab = outlines.place(stone, outlines.arch(kind, wide, high)):extrude(-0.14)
        add(slab:rotate(90 + random(-4, 4), vec(0, 0, 1)), if random() < 0.5 then "#b3a98f" else "#9c9a90")
      end
    end
  end
  return sequence(parts), Flank(1), Flank(-1), Apse(), West(), Tower(), Roofs()
end)
-- One side of the nave and its aisle, split into bays; on the left, the tower replaces the first bay.
church:rule("Flank(sign)", function(this, sign: number)
  local from = if sign < 0 then BAY else 0
  local parts: { any } = {}
  local function face(x: number, low: number, high: number): Shape
    local a, b = vec(sign * x, from, low), vec(sign * x, length, low)
    local up = vec(0, 0, high - low)
    return outlines.face(if sign > 0 then { a, b, b + up, a + up } else { b, a, a + up, b + up })
  end
  local function place(of: Shape, which: any)
    for _, bay in of:split("x", { `{BAY}*` }) do
      table.insert(parts, { At(which, bay:position(), bay:z_axis()) })
    end
  end
  place(face(half + AISLE, 0, LOW), aisle)
  place(face(half, LEAN, HIGH), clerestory)
  for number = from / BAY, bays do
    if sign > 0 or number > 1 then
      table.insert(parts, { At(support, vec(sign * (half + AISLE), number * BAY, 0), vec(sign, 0, 0)) })
    end
  end
  -- The lean-to roof, and the end walls of the aisle.
  local ends = if sign > 0 then { from, length } else { length }
  local section = {
    { half, LOW - 0.2 },
    { half + AISLE, LOW - 0.2 },
    { half + AISLE, LOW + 0.1 },
    { half, LEAN },
  }
  local function slab(y: number, long: number, color: string, outline: any, thick: number)
    local points: { any }, ring: { number } = {}, {}
    for at, point in outline do
      points[at] = vec(sign * point[1], y, point[2] + thick)
      table.insert(ring, if sign > 0 then #ring + 1 else 1, at)
    end
    table.insert(parts, Draw(shape({ points = points, faces = { ring } }):extrude(-long):color(color)))
  end
  slab(from, length - from, SLATE, section, 0)
  if sign > 0 then
    local front = wall(AISLE - 1.6, LOW - 0.6):translate(vec(half + 1, -0.32, 0))
    for _, part in
      tracery.window(front, { width = 1.3, lancets = 1, height = 4.2, sill = 2.1, wall = false, depth = 0.1 })
    do
      table.insert(parts, Draw(part:shift(vec(0, 0, 0.12))))
    end
    table.insert(parts, Draw(band(front, 1.6, 0.22, 0.14)))
  end
  for _, y in ends do
    local outline = { { half, 0 }, { half + AISLE, 0 }, { half + AISLE, LOW + 0.9 }, { half, LEAN + 0.9 } }
    slab(if y == 0 then -0.3 else y - 0.3, 0.6, STONE, outline, 0)
  end
  return sequence(parts)
end)
-- Five sides of a decagon, with a buttress at each corner.
church:rule("Apse()", function(this)
  local parts: { any } = {}
  local center = vec(0, length, 0)
  for number = 0, 4 do
    local middle = math.rad(18 + 36 * number)
    local out = vec(math.cos(middle), math.sin(middle), 0)
    local aside = vec(-math.sin(middle), math.cos(middle), 0)
    local at = center + out * (half * math.cos(math.pi / 10)) - aside * (apse_side / 2)
    table.insert(parts, { At(apse, at, out) })
  end
  for number = 0, 5 do
    local angle = math.rad(36 * number)
    local out = vec(math.cos(angle), math.sin(angle), 0)
    table.insert(parts, { At(corner_support, center + out * (half - 0.1), out) })
  end
  return sequence(parts)
end)
-- The portal, the rose, and the gable above the roof between two turrets.
church:rule("West()", function(this)
  local parts: { any } = {}
  local function add(shapes: any)
    for _, part in shapes do
      table.insert(parts, Draw(part))
    end
  end
  local front = wall(width, HIGH):translate(vec(-half, -0.4, 0))
  local split_at = 8.6
  local rows = front:split("y", { split_at, "~1" })
  add(openings.portal(rows[1], { width = 2.4, height = 4.8, step = 0.22, lintel = 2.9, gable = 0.3 }))
  add(tracery.rose(rows[2], { radius = math.min(half - 1, (HIGH - split_at) / 2 - 0.6) }))
  add({ band(rows[1], split_at - 0.2, 0.4, 0.25), band(rows[2], HIGH - split_at - 0.4, 0.5, 0.3) })
  -- The gable hides the end of the roof; its coping carries a cross.
  local top = wall(width, rise + 2):translate(vec(-half, -0.4, HIGH))
  local gable = { { -0.4, 0 }, { width + 0.4, 0 }, { half, rise + 1.4 } }
  local foil = outlines.foil(half, rise * 0.34, 1.1, 3)
  local plate = outlines.place(top, gable, { foil }):extrude(-0.9)
  local glass = outlines.place(top, outlines.circle(half, rise * 0.34, 1.2), nil, -0.4)
  local edge = {
    { -0.6, 0 },
    { -0.1, 0 },
    { half, rise + 0.95 },
    { width + 0.1, 0 },
    { width + 0.6, 0 },
    { half, rise + 1.8 },
  }
  add({ plate, glass:color("#33415c"), outlines.place(top, edge, nil, -0.95):extrude(1.2):color(TRIM) })
  for _, bar in { { 0.16, 1.6, 0 }, { 0.9, 0.16, 0.9 } } do
    local box = cuboid(bar[1], 0.16, bar[2])
    add({ box:translate(vec(-bar[1] / 2, -0.7, HIGH + rise + 1.5 + bar[3])):color(TRIM) })
  end
  -- Steps before the portal.
  for step = 0, 2 do
    local slab =
      rectangle(5 + step, 3.4 + 0.4 * step):translate(vec(-2.5 - step / 2, -1.6 - 0.4 * step, -0.02))
    add({ slab:extrude(0.42 - 0.14 * step):color(TRIM) })
  end
  for sign = -1, 1, 2 do
    local at = vec(sign * (half + 0.3), -0.4, 0)
    table.insert(parts, { At(corner_support, at, vec(0, -1, 0)) })
    local turret = rectangle(1.3, 1.3):translate(at + vec(-0.65, -0.6, HIGH - 1.4))
    add(supports.pinnacle(turret, { height = 8, shaft = 0.42, crockets = 6 }))
  end
  return sequence(parts)
end)
-- Three stages with buttresses at the corners, a parapet, pinnacles and a spire.
church:rule("Tower()", function(this)
  local parts: { any } = {}
  local function add(shapes: any)
    for _, part in shapes do
      table.insert(parts, Draw(part))
    end
  end
  local plan = rectangle(side, side):translate(vec(-half - side, -1.2, 0))
  local mass = plan:extrude(tower)
  local stages = { tower * 0.34, tower * 0.28, tower * 0.38 }
  for _, stage in mass:split("z", stages) do
    for _, face in stage:faces("side") do
      local size = face:size()
      if stage:index() == 3 then
        for _, light in face:split("x", { 1, "~1", "~1", 1 }) do
          if light:index() == 1 or light:index() == 4 then
            add({ light })
          else
            local glass =
              { width = light:size().x - 0.5, height = size.y - 2.6, sill = 1, glass = "#2a2d31", bars = 14 }
            add(tracery.window(light, glass))
          end
        end
      else
        add(
          tracery.window(
            face,
            { lancets = 1, width = 1, height = size.y * 0.5, sill = size.y * 0.26, bar = 0.1 }
          )
        )
      end
      add({ band(face, size.y - 0.4, 0.4, 0.28) })
    end
  end
  for _, face in mass:faces("side") do
    for _, x in { 0.55, side - 0.55 } do
      local at = face:position() + face:x_axis() * x
      table.insert(parts, { At(corner_support, at, face:z_axis()) })
    end
    add(balustrades.pierced(face:shift(vec(0, tower, -0.1)), { spacing = 0.8, height = 1.2 }))
  end
  local top = mass:faces("up")[1]
  add({ top })
  add(
    cornices.cornice(
      top:translate(vec(0, 0, -0.6)),
      { profile = "cavetto", height = 0.6, depth = 0.35, color = TRIM }
    )
  )
  for _, x in { 0, side - 0.9 } do
    for _, y in { 0, side - 0.9 } do
      local corner = rectangle(0.9, 0.9):translate(top:position() + vec(x, y, -0.1))
      add(supports.pinnacle(corner, { height = 4.6 }))
    end
  end
  add(
    roofs.spire(
      top:setback(0.5)[1],
      { height = tower * 0.78, overhang = 0, lucarnes = 2, tiles = SLATE, cross = 1.6 }
    )
  )
  return sequence(parts)
end)
-- The roof of the nave, which ends as a half cone over the apse, and a small spire on its ridge.
church:rule("Roofs()", function(this)
  local eave, thick = half + 0.5, 0.5 * math.tan(math.rad(steepness))
  local base, ridge = HIGH - 0.1 + 0.3 - thick, HIGH + rise + 0.2
  local points: { any } = {
    vec(-eave, 0, base),
    vec(eave, 0, base),
    vec(0, 0, ridge),
    vec(0, length, ridge),
  }
  for number = 0, 5 do
    local angle = math.rad(36 * number)
    table.insert(points, vec(eave * math.cos(angle), length + eave * math.sin(angle), base))
  end
  local faces: { any } = { { 1, 2, 3 }, { 2, 5, 4, 3 }, { 1, 3, 4, 10 }, { 2, 1, 10, 9, 8, 7, 6, 5 } }
  for number = 5, 9 do
    table.insert(faces, { number, number + 1, 4 })
  end
  local roof = shape({ points = points, faces = faces })
  local crest = cuboid(0.22, length, 0.2):translate(vec(-0.11, 0, ridge - 0.08))
  local parts: { any } = { Draw(roof:color(SLATE)), Draw(crest:color("#454c54")) }
  -- Small dormers in every other bay of both slopes.
  local x = half * 0.6
  local low = ridge - x * math.tan(math.rad(steepness)) - 0.1
  for number = 1, bays - 1, 2 do
    for sign = -1, 1, 2 do
      local at = vec(sign * x, (number + 0.5) * BAY, low)
      local aside, up = vec(0, sign * 0.6, 0), vec(0, 0, 2)
      local front = outlines.face({ at - aside, at + aside, at + aside + up, at - aside + up })
      local window =
        { kind = "pointed", width = 0.5, height = 0.75, sill = 0.15, depth = 0.08, columns = 1, rows = 1 }
      local dormer = {
        width = 0.9,
        height = 1,
        depth = 1.2,
        roof = 0.8,
        overhang = 0.1,
        tiles = SLATE,
        wall = TRIM,
        window = window,
      }
      for _, part in roofs.dormer(front, dormer) do
        table.insert(parts, Draw(part))
      end
    end
  end
  local small = rectangle(1.5, 1.5):translate(vec(-0.75, length - BAY, ridge - 0.9)):extrude(2.2)
  table.insert(parts, Draw(small:color("#4c545c")))
  for _, part in roofs.spire(small:faces("up")[1], { height = 9, lucarnes = 0, tiles = SLATE, cross = 1 }) do
    table.insert(parts, Draw(part))
  end
  return sequence(parts)
end)
church:interpret("At(model, place, out)", function(this, which: any, place: Vector, out: Vector)
  this:jump(place):direction(vec(0, 0, 1), -out):place(which)
end)
church:derive()

camera({ from = vec(43, -46, 2.4), to = vec(0.5, 8, 18.2), fov = 46 })
camera({ name = "above", from = vec(64, -34, 46), to = vec(0, length * 0.42, 16), fov = 50 })
