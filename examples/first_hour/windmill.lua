--!strict
-- A windmill: a rule stacks storeys on each other, and the cap carries four lattice sails that turn.
-- A film of its turn: burgeon run windmill.lua --frames 0:0.24:0.01 -o windmill.gif
local storeys = param("storeys", { default = 4, min = 3, max = 8, step = 1, doc = "Number of storeys" })
local reach = param("reach", { default = 11, min = 6, max = 14, unit = "m", doc = "Length of a sail" })
local time = param("time", { default = 0.1, min = 0, max = 1, doc = "Part of a turn of the sails" })

local WHITE, BRICK, SHINGLE, GLASS = "#efe9dc", "#a4583f", "#6a5a48", "#2d3a44"
local HEIGHT, TAPER = 3, 0.86

-- A sail along z: a stock, a board on one side of it, and a lattice on the other.
local Sail = module("Sail")
local carpentry = lsystem({ object = extruder({ color = WHITE }) })
carpentry:axiom(Sail())
carpentry:interpret("Sail", function(this)
  local length = reach - 2
  local function beam(x: number, y: number, z: number, at: Vector, color: Color?)
    this:shape(cuboid(x, y, z):translate(at), color)
  end
  this:shape(rectangle(0.34, 0.34):translate(vec(-0.17, -0.17, 0)):taper(reach, 0.5), "#7a3b2c")
  beam(0.45, 0.04, length, vec(-0.55, 0.02, 2), "#c8b48c")
  beam(0.07, 0.07, length, vec(0.7, 0, 2))
  beam(0.07, 0.07, length, vec(1.4, 0, 2))
  for z = 2, reach, 0.5 do
    beam(1.5, 0.06, 0.06, vec(0, 0, z))
  end
end)
local sail = carpentry:derive()

local Storey, Wall = module("Storey", "number", "radius"), module("Wall", "radius", "color")
local Windows, Door = module("Windows", "radius"), module("Door", "radius")
local Gallery, Cap = module("Gallery", "radius"), module("Cap", "radius")
local mill = lsystem({ object = extruder({ sides = 8, smooth = false }) })
mill:axiom({ Door(4.4) }, Storey(1, 4.4))
mill:rule("Storey(number, radius)", function(this, number: number, radius: number)
  local top = radius * TAPER
  local next = if number < storeys then Storey(number + 1, top) else Cap(top)
  if number == 1 then
    return Wall(radius, BRICK), next
  elseif number == 2 then
    return Wall(radius, BRICK), { Gallery(top) }, next
  end
  return { Windows(radius) }, Wall(radius, SHINGLE), next
end)

-- Each row of bricks or shingles is wider at its lower edge.
mill:interpret("Wall(radius, color)", function(this, radius, color)
  for row = 0, 11 do
    local shade = mix(color, "#3a2d24", choose({ 0, 0.07, 0.14, 0.2 }))
    this
      :color(shade)
      :scale(radius * lerp(1, TAPER, row / 12) + 0.06)
      :taper(radius * lerp(1, TAPER, (row + 1) / 12))
    this:extrude(HEIGHT / 12)
  end
end)
-- A frame with panes, or a door, in the middle of the wall that looks in the direction `out` (degrees).
local function opening(this: Extruder, out: number, radius: number, up: number, wide: number, high: number)
  local way = vec(math.cos(math.rad(out)), math.sin(math.rad(out)), 0)
  local place = this:position() + way * radius * math.cos(math.rad(22.5)) + vec(0, 0, up)
  this:jump(place):shape(cuboid(0.5, wide, high):translate(vec(-0.25, -wide / 2, 0)):rotate(out), WHITE)
  local inner = cuboid(0.55, wide - 0.24, high - 0.24):translate(vec(-0.275, 0.12 - wide / 2, 0.12))
  this:shape(inner:rotate(out), GLASS)
end
mill:interpret("Windows(radius)", function(this, radius)
  local start = this:position()
  for side = 0, 3 do
    this:jump(start)
    opening(this, 22.5 + 90 * side, 0.95 * radius, 0.7, 1.1, 1.4)
  end
end)
mill:interpret("Door(radius)", function(this, radius)
  opening(this, 292.5, radius, 0, 1.5, 2.4)
end)
mill:interpret("Gallery(radius)", function(this, radius)
  this:color("#b59a6c"):scale(radius + 1.8):extrude(0.18)
  local floor, rim = this:position(), disk(radius + 1.7, 8):points()
  for number, corner in rim do
    local next = rim[number % 8 + 1]
    for part = 0, 3 do
      this:jump(floor + lerp(corner, next, part / 4)):color(WHITE):scale(0.06):extrude(1.05)
    end
    local out = corner:unit()
    this:jump(floor + out * (radius + 0.1) - vec(0, 0, 1.9)):color("#7a5f40")
    this:direction(out + vec(0, 0, 1.4)):scale(0.09):extrude(2.1):direction({ 0, 0, 1 })
  end
  for _, up in { 0.55, 1.05 } do
    this:jump(floor + vec(0, 0, up)):shape(disk(0.05, 8):sweep(rim, { closed = true }), WHITE)
  end
end)
mill:interpret("Cap(radius)", function(this, radius)
  this:regular(32):smooth(true):color(WHITE):scale(radius + 0.15):extrude(0.4)
  local floor, wide = this:position(), radius + 0.3
  this:color("#5f4a38")
  for turn = 0, 80, 10 do
    local from, to = math.rad(turn), math.rad(turn + 10)
    this:scale(wide * math.cos(from)):taper(wide * math.cos(to))
    this:extrude(0.85 * radius * (math.sin(to) - math.sin(from)))
  end
  this
    :color("#4a3a2c")
    :jump(floor + vec(0, 0, 0.9))
    :direction({ 0, -1, 0.06 })
    :scale(0.32)
    :extrude(radius + 1.7)
  for number = 0, 3 do
    local turn = math.rad(360 * time + 90 * number)
    this
      :jump(floor + vec(0, -radius - 1.3, 1))
      :direction({ math.sin(turn), 0, math.cos(turn) }, { 0, 1, 0 })
      :place(sail)
  end
end)
mill:derive()
local far = (3 * storeys + math.max(reach, 9)) / 23
camera({ name = "meadow", from = far * vec(20, -41, 9), to = far * vec(0, 0, 10.4), fov = 36 })
