--!strict
-- A sheet of the elements of the package in mods/elements: each stands on a plain, in rows by subject.
local elements = require("@elements")
local openings, tracery, columns = elements.openings, elements.tracery, elements.columns
local cornices, balustrades, stairs = elements.cornices, elements.balustrades, elements.stairs
local bays, supports, roofs = elements.bays, elements.supports, elements.roofs

local STONE, TILES = "#d8cbb0", "#6f4a3f"
local sheet = lsystem({ object = extruder({ color = STONE }) })
local shown: { any } = {}
local row, x = 0, 0

local function draw(shapes: { Shape })
  for _, part in shapes do
    table.insert(shown, Draw(part))
  end
end
-- Windows consist of glass and reveals too; all other elements are solids.
local with_windows = { [bays.bay] = true, [bays.loggia] = true, [roofs.dormer] = true, [roofs.spire] = true }
local function draw_solids(make: any, shapes: { Shape })
  for number, part in shapes do
    if not with_windows[make] then
      expect(part:volume() > 0 or `part {number} is open or inside out`, true)
    end
  end
  draw(shapes)
end
-- The front of a wall at the end of the row.
local function wall(width: number, height: number): Shape
  local front = cuboid(width, 0.6, height):translate(vec(x, row, 0)):faces("front")[1]
  x += width + 1.2
  return front
end
-- The wall and what stands in front of it.
local function before(width: number, height: number, make: any, options: any?)
  local front = wall(width, height)
  draw({ front:extrude(-0.6) })
  draw_solids(make, make(front, options))
end
-- An element that makes its own wall.
local function within(width: number, height: number, make: any, options: any?)
  local front = wall(width, height)
  draw(make(front, options))
  for _, face in front:extrude(-1.8):faces() do
    if face:z_axis():dot(front:z_axis()) < 0.9 then
      draw({ face })
    end
  end
end
-- A plan on the ground at the end of the row.
local function on(width: number, depth: number, make: any, options: any?)
  draw_solids(make, make(rectangle(width, depth):translate(vec(x, row - depth / 2, 0)), options))
  x += width + 1.2
end
local function next_row(distance: number)
  row += distance
  x = 0
end

-- Balustrades, cornices and stairs.
before(3, 1.2, balustrades.stone)
before(3, 1.2, balustrades.iron, { rings = true, spacing = 0.16 })
before(3, 1.2, balustrades.pierced)
on(1.4, 3.4, stairs.straight, { height = 1.7 })
on(1.4, 5, stairs.landing, { height = 2.2 })
on(2.4, 2.4, stairs.spiral, { height = 2.6 })
on(1.4, 3.4, stairs.ramp)
on(2.4, 2.4, stairs.podium, { height = 0.6 })
next_row(7)
-- Columns, cornices and supports.
on(1.2, 1.2, columns.column, { order = "tuscan", radius = 0.3 })
on(1.2, 1.2, columns.column, { order = "doric", radius = 0.34, flute = 0.07, sides = 40 })
on(1.2, 1.2, columns.column, { order = "ionic", radius = 0.28, flute = 0.08, sides = 40 })
before(1.2, 4.2, columns.pilaster)
before(1.6, 4.2, columns.half_column, { order = "ionic", height = 4.2 })
for _, profile in { "cavetto", "ovolo", "cyma", "classical" } do
  local front = wall(1.2, 4.2)
  local block = front:extrude(-1.2)
  draw({ block })
  draw(cornices.cornice(block:faces("up")[1]:translate(vec(0, 0, -0.5)), { profile = profile }))
end
before(2.4, 4.2, cornices.dentils)
before(2.4, 4.2, cornices.brackets, { spacing = 0.7 })
next_row(9)
-- Windows and doors.
for _, kind in { "rectangle", "segmental", "round", "pointed" } do
  within(2.2, 3.6, openings.window, { kind = kind, keystone = kind == "round" })
end
for _, kind in { "rectangle", "segmental", "round", "pointed" } do
  within(2.2, 3.6, openings.door, { kind = kind, light = 0.4 })
end
next_row(8)
-- Bays and dormers.
before(4, 5, bays.bay)
before(4, 6, bays.bay, { sill = 1.6, corbel = 1.2, depth = 0.8, height = 2.8 })
before(3.4, 4.2, bays.balcony, { sill = 1.2 })
before(4, 4.2, bays.balcony, { sill = 1.2, railing = "stone", width = 3.2 })
within(3.4, 3.4, bays.loggia)
before(3, 5, roofs.turret)
next_row(11)
for _, kind in { "gable", "hip", "shed", "eyebrow" } do
  local front = wall(2.6, 1.4)
  local slope = elements.outlines.across(front, { { 0.6, 0 }, { -4, 3.4 }, { -4, 0 } }, -0.4, 3.4)
  draw({ slope:color("#8a5a48") })
  draw(roofs.dormer(front:translate(vec(0, 0.6, 0.5)), {
    kind = kind,
    width = if kind == "eyebrow" then 2.6 else 1.4,
    tiles = TILES,
    depth = 2.8,
  }))
end
on(1.2, 0.5, roofs.chimney)
before(2.2, 7, supports.buttress, { height = 6.4 })
within(7, 4.4, supports.arcade, { depth = 0.6 })
on(0.9, 0.9, supports.pinnacle)
on(3, 3, roofs.spire, { height = 9 })
next_row(13)
-- Tracery.
within(2.4, 7, tracery.window, { lancets = 1, width = 1.1 })
within(3.6, 7, tracery.window)
within(5.4, 8, tracery.window, { lancets = 4, width = 4, height = 6 })
within(5.6, 8, tracery.rose)
within(6, 8, openings.portal)
local high = wall(2, 10)
draw({ high:extrude(-0.6) })
draw(supports.flyer(high))
draw(supports.buttress(high:translate(vec(0, -5, 0)), { height = 6.6, depth = 1 }))

-- Elements refuse what does not fit.
local narrow = cuboid(1, 1, 2):faces("front")[1]
for _, refused in
  { { openings.window }, { openings.door }, { tracery.window }, { tracery.rose }, { bays.bay } }
do
  expect((pcall(refused[1], narrow)), false)
end
expect((pcall(openings.window, narrow, { width = 0.5, height = 0 })), false)
expect((pcall(openings.window, narrow, { width = 0.5, height = 1, sill = -1 })), false)
expect((pcall(columns.column, rectangle(1, 1), { order = "gothic" })), false)
expect((pcall(stairs.straight, rectangle(1, 1), { height = 3 })), false)

sheet:axiom(sequence(shown))
sheet:derive()

camera({ from = vec(14.6, -31, 32), to = vec(14.6, 17.4, 0.2), fov = 38 })
