--!strict
-- A street segment with lanes, kerbs, markings, lamps, trees and parked cars, as in CGA's example of modern streets: one face is
-- split across into strips, and each strip along into what stands on it.
local elements = require("@elements")
local outlines, openings = elements.outlines, elements.openings

local place_outline: (face: Shape, outline: any, holes: { any }?, z: number?) -> Shape = outlines.place
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned

local length = param("length", { default = 96, min = 40, max = 300, unit = "m" })
local lanes = param("lanes", { default = 1, min = 1, max = 3, step = 1, doc = "Lanes in each direction." })
local spacing =
  param("spacing", { default = 11, min = 6, max = 30, unit = "m", doc = "Distance between trees and lamps." })

local ASPHALT, PAVING, KERB, WHITE, CYCLE = "#54575a", "#b3aca0", "#c9c6bf", "#e9e7e0", "#8a4f43"
local Street, Pavement, Kerb, Parking, Lane, Track, Line, Dashes, Crossing, Row, House =
  module("Street", "face"),
  module("Pavement", "face"),
  module("Kerb", "face"),
  module("Parking", "face"),
  module("Lane", "face"),
  module("Track", "face"),
  module("Line", "face"),
  module("Dashes", "face"),
  module("Crossing", "face"),
  module("Row", "face"),
  module("House", "face")
local At = module("At", "model", "place", "turn")

local function model(parts: { any }): Derived
  local list: { any } = {}
  for at, part in parts do
    list[at] = Draw(part)
  end
  local system = lsystem({ object = extruder({ color = "#3a3d40" }) })
  system:axiom(sequence(list))
  return system:derive()
end
-- A street lamp with an arm over the road, towards x.
local lamp = model({
  turn_profile({ { 0.14, 0 }, { 0.14, 0.9 }, { 0.08, 1 }, { 0.06, 7.4 }, { 0, 7.5 } }, 10),
  cuboid(1.7, 0.07, 0.07):translate(vec(-0.1, -0.035, 7.3)),
  cuboid(0.8, 0.26, 0.1):translate(vec(1.1, -0.13, 7.24)):color("#dfe3e4"),
})
-- A tree: a trunk, and a crown of balls around it.
local function tree(seed: number): Derived
  local parts: { any } = {
    turn_profile({ { 0.2, 0 }, { 0.13, 0.6 }, { 0.1, 3.4 }, { 0.02, 5.4 } }, 8):color("#6a5744"),
  }
  for number = 1, 13 do
    local angle = math.rad(number * 137.5 + seed * 50)
    local far = 1.35 * math.sqrt(number / 13) * (1 + 0.2 * noise(number, seed))
    local up = 4.6 + 1.5 * noise(number * 1.7, seed + 9) + (1.4 - far) * 0.7
    local size = 0.95 + 0.25 * noise(seed, number * 2.3)
    local crown = ball(size, 9):translate(vec(far * math.cos(angle), far * math.sin(angle), up))
    table.insert(parts, crown:color(({ "#7f9352", "#6b8347", "#5d7440" })[number % 3 + 1]))
  end
  return model(parts)
end
local trees = { tree(1), tree(2), tree(3) }
-- A parked car, along y.
local function car(color: string): Derived
  local side = cuboid(1.76, 4.3, 2):translate(vec(-0.88, -2.15, 0)):faces("left")[1]
  local body = {
    { 0, 0.3 },
    { 4.3, 0.3 },
    { 4.3, 0.78 },
    { 4.1, 0.9 },
    { 3.1, 0.98 },
    { 0.2, 1 },
    { 0, 0.85 },
  }
  local cabin = { { 0.35, 0.95 }, { 3.3, 0.95 }, { 2.45, 1.46 }, { 0.85, 1.46 } }
  local roof = { { 0.8, 1.44 }, { 2.5, 1.44 }, { 2.4, 1.5 }, { 0.95, 1.5 } }
  local parts: { any } = {
    place_outline(side, body):extrude(-1.76):color(color),
    place_outline(side, cabin, nil, -0.1):extrude(-1.56):color("#26313a"),
    place_outline(side, roof, nil, -0.16):extrude(-1.44):color(color),
  }
  for _, y in { 0.85, 3.45 } do
    for _, z in { 0.03, -1.57 } do
      local wheel = place_outline(side, outlines.circle(y, 0.32, 0.32, 16), nil, z)
      table.insert(parts, wheel:extrude(-0.22):color("#1d1f21"))
      table.insert(
        parts,
        place_outline(side, outlines.circle(y, 0.32, 0.18, 12), nil, z):extrude(0.02):color("#b9bcbe")
      )
    end
  end
  return model(parts)
end
local cars = { car("#8d2f2a"), car("#35506b"), car("#c8c9c6"), car("#2f3336"), car("#6b7d63") }
local bench = model({
  cuboid(1.8, 0.5, 0.07):translate(vec(-0.9, -0.25, 0.42)):color("#8a6a4a"),
  cuboid(1.8, 0.06, 0.4):translate(vec(-0.9, 0.22, 0.52)):color("#8a6a4a"),
  cuboid(0.08, 0.46, 0.42):translate(vec(-0.7, -0.23, 0)),
  cuboid(0.08, 0.46, 0.42):translate(vec(0.62, -0.23, 0)),
})

local street = lsystem({ object = extruder({ color = "#cbbfa8" }) })
local half = 4.6 + 0.25 + 1.7 + 2.2 + 3.2 * lanes
street:axiom(Street(rectangle(2 * half, length)))
-- The strips from the left to the right, the same on both sides of the middle.
street:rule("Street(face)", function(this, face: Shape)
  local parts: { any } =
    { { 4.6, Pavement }, { 0.25, Kerb }, { 1.7, Track }, { 2.2, Parking }, { "~0.12", Line } }
  for lane = 1, 2 * lanes do
    table.insert(parts, { "~3", Lane })
    table.insert(parts, { 0.12, if lane == lanes or lane < 2 * lanes then Dashes else Line })
  end
  for at = 4, 1, -1 do
    table.insert(parts, parts[at])
  end
  local front = rectangle(12, length):translate(vec(-12, 0, 0.15))
  return split(face, "x", parts), Row(front), Row(rectangle(12, length):translate(vec(2 * half, 0, 0.15)))
end)
street:rule("Lane(face)", function(this, face: Shape)
  local function road(part: Shape)
    return Draw(part:color(ASPHALT))
  end
  return split(face, "y", { { 5, road }, { 3.6, Crossing }, { "~1", road } })
end)
street:rule("Line(face)", function(this, face: Shape)
  return split(face, "y", {
    { 9, Draw },
    {
      "~1",
      function(part: Shape)
        return Draw(part:color(WHITE))
      end,
    },
  })
end)
street:rule("Dashes(face)", function(this, face: Shape)
  local function gap(part: Shape)
    return Draw(part:color(ASPHALT))
  end
  local function dash(part: Shape)
    return Draw(part:color(WHITE))
  end
  return split(face, "y", { { 9, gap }, { { "~3", dash }, { "~5", gap } } })
end)
-- Bars across the lane.
street:rule("Crossing(face)", function(this, face: Shape)
  local function bar(part: Shape)
    return Draw(part:color(if part:index() % 2 == 1 then WHITE else ASPHALT))
  end
  return split(face, "x", { { "~0.5*", bar } })
end)
-- A cycle track, raised by half a kerb.
street:rule("Track(face)", function(this, face: Shape)
  return Draw(face:extrude(0.07):color(CYCLE))
end)
street:rule("Kerb(face)", function(this, face: Shape)
  return split(face, "y", {
    {
      "~1*",
      function(part: Shape)
        return Draw(part:extrude(0.16):color(mix(KERB, "#a9a69e", math.floor(random(0, 4)) / 8)))
      end,
    },
  })
end)
-- Parking spaces between marks, with a car in most of them, and trees in beds.
street:rule("Parking(face)", function(this, face: Shape)
  local turn = if face:center().x < half then 0 else 180
  local function space(part: Shape)
    local parts: { any } = { Draw(part:color("#63666a")) }
    if random() < 0.7 then
      local at = part:center() + vec(0, random(-0.4, 0.4), 0)
      table.insert(parts, { At(cars[math.floor(random() * #cars) + 1], at, turn) })
    end
    return sequence(parts)
  end
  local function bed(part: Shape)
    local soil = part:setback(0.15)[1]
    local which = trees[math.floor(random() * #trees) + 1]
    return Draw(part:extrude(0.15):color(KERB)),
      Draw(soil:extrude(0.18):color("#6a7a48")),
      { At(which, part:center() + vec(0, 0, 0.15), random(0, 360)) }
  end
  local function mark(part: Shape)
    return Draw(part:color(WHITE))
  end
  local spaces = math.max(1, math.round((spacing - 1.8) / 5.2))
  local group: { any } = { { 1.8, bed } }
  for _ = 1, spaces do
    table.insert(group, { "~5.2", space })
    table.insert(group, { 0.1, mark })
  end
  local function plain(part: Shape)
    return Draw(part:extrude(0.15):color(PAVING))
  end
  return split(face, "y", { { 9.4, plain }, group, { 1.8, bed } })
end)
-- Paving with lamps at the kerb and benches.
street:rule("Pavement(face)", function(this, face: Shape)
  local right = face:center().x > half
  local parts: { any } = {}
  for _, row in face:split("y", { `~{spacing / 6}*` }) do
    for _, slab in row:split("x", { "~1.15*" }) do
      table.insert(
        parts,
        Draw(slab:extrude(0.15):color(mix(PAVING, "#989186", math.floor(random(0, 5)) / 8)))
      )
    end
  end
  for number, part in face:split("y", { 9.4, `~{spacing}*` }) do
    local y = part:position().y
    if number > 1 and number % 2 == 0 then
      local x = if right then face:position().x + 0.5 else face:position().x + face:size().x - 0.5
      table.insert(parts, { At(lamp, vec(x, y, 0.15), if right then 180 else 0) })
    elseif number > 1 then
      local x = if right then face:position().x + 0.6 else face:position().x + face:size().x - 0.6
      table.insert(parts, { At(bench, vec(x, y + 3, 0.15), if right then 90 else -90) })
    end
  end
  return sequence(parts)
end)
-- Houses of several widths and heights on both sides.
street:rule("Row(face)", function(this, face: Shape)
  local widths: { any } = {}
  local rest = length
  while rest > 13 do
    local width = math.min(rest, random(9, 15))
    table.insert(widths, { `~{width}`, House })
    rest -= width
  end
  return split(face, "y", widths)
end)
street:rule("House(face)", function(this, face: Shape)
  local colors = { "#cdb994", "#b9a58f", "#a8694f", "#d9d2c2", "#8f9a9a", "#c2a06b" }
  local color = colors[math.floor(random() * #colors) + 1]
  local floors = math.floor(random(3, 6))
  local mass = face:extrude(4.2 + 3.1 * floors)
  local front = mass:faces(if face:center().x < half then "right" else "left")[1]
  local parts: { any } = {}
  local function add(shapes: { Shape })
    for at, part in shapes do
      table.insert(parts, Draw(if at == 1 then part:color(color) else part))
    end
  end
  for _, side in mass:faces() do
    if side:z_axis():dot(front:z_axis()) < 0.9 then
      table.insert(parts, Draw(side:color(color)))
    end
  end
  local bays = math.max(2, math.round(front:size().x / 2.9))
  for _, storey in front:split("y", { 4.2, "~3.1*" }) do
    local bottom = storey:index() == 1
    for _, bay in storey:split("x", { `~{front:size().x / bays}*` }) do
      if bottom and bay:index() == 1 then
        add(openings.door(bay, { leaves = 1, width = 1.2, height = 3, light = 0.7, surround = 0.1 }))
      elseif bottom then
        add(openings.window(bay, {
          width = bay:size().x - 0.5,
          height = 2.9,
          sill = 0.5,
          columns = 2,
          rows = 1,
          surround = 0,
          bench = 0,
          wood = "#3a3f42",
        }))
      else
        add(openings.window(bay, { width = 1.2, height = 1.9, sill = 0.6, surround = 0.08 }))
      end
    end
    local ledge = storey:split("y", { "~1", 0.22 })[2]
    table.insert(parts, Draw(ledge:extrude(0.14):color("#d8d0c0")))
  end
  local roof = mass:faces("up")[1]
  table.insert(
    parts,
    Draw(roof:molding({ { -0.25, 0 }, { 0.2, 0.1 }, { 0.3, 0.5 }, { -0.25, 0.5 } }):color("#d8d0c0"))
  )
  return sequence(parts)
end)
street:interpret("At(model, place, turn)", function(this, which: any, place: Vector, turn: number)
  local angle = math.rad(turn)
  this:jump(place):direction(vec(0, 0, 1), vec(-math.sin(angle), math.cos(angle), 0)):place(which)
end)
street:derive()

camera({ from = vec(half + 2.4, -7, 5.4), to = vec(half - 0.8, 34, 3.4), fov = 52 })
