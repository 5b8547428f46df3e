--!strict
-- A walled garden with a maze: a rule divides each field by a hedge with one gap, so that one path joins all places.
local columns =
  param("columns", { default = 19, min = 9, max = 60, step = 1, doc = "Paths from west to east" })
local rows = param("rows", { default = 15, min = 9, max = 60, step = 1, doc = "Paths from south to north" })
local hedge = param("hedge", { default = "#486a33", doc = "Colour of the hedges" })

local PATH, HIGH, THICK = 1.6, 1.7, 0.5

-- A field has its first column and row, and its numbers of columns and rows. A border gets a gap.
local Field, Border = module("Field", "x", "y", "wide", "deep"), module("Border", "x", "y", "to_x", "to_y")
local Hedge, Garden = module("Hedge", "x", "y", "to_x", "to_y"), module("Garden")
local Wall, Pier, Bush = module("Wall", "from", "to"), module("Pier", "place"), module("Bush", "place")
local Fountain = module("Fountain")
local garden = lsystem({ object = extruder({ sides = 32, roughness = 0.9 }) })

-- Four fields turn around a court of 3 by 3 paths in the middle. The maze opens to the south.
local cx, cy = math.floor(columns / 2) - 1, math.floor(rows / 2) - 1
local ex, ey = cx + 3, cy + 3
garden:axiom(
  { Garden() },
  { Fountain() },
  Field(0, 0, ex, cy),
  Field(ex, 0, columns - ex, ey),
  Field(cx, ey, columns - cx, rows - ey),
  Field(0, cy, cx, rows - cy),
  Border(ex, 0, ex, cy),
  Border(ex, ey, columns, ey),
  Border(0, cy, cx, cy),
  Hedge(cx, ey, cx, rows),
  Hedge(cx, cy, ex, cy),
  Hedge(cx, cy, cx, ey),
  Hedge(ex, cy, ex, ey),
  Border(cx, ey, ex, ey),
  Hedge(0, 0, cx + 1, 0),
  Hedge(cx + 2, 0, columns, 0),
  Hedge(0, rows, columns, rows),
  Hedge(0, 0, 0, rows),
  Hedge(columns, 0, columns, rows)
)
garden:rule("Field(x, y, wide, deep)", function(this, x, y, wide, deep)
  if wide < 2 or deep < 2 then
    return nil
  end
  if wide + random() > deep + random() then
    local at = x + math.floor(random(1, wide))
    return Border(at, y, at, y + deep), Field(x, y, at - x, deep), Field(at, y, x + wide - at, deep)
  end
  local at = y + math.floor(random(1, deep))
  return Border(x, at, x + wide, at), Field(x, y, wide, at - y), Field(x, at, wide, y + deep - at)
end)
garden:rule("Border(x, y, to_x, to_y)", function(this, x, y, to_x, to_y)
  if x == to_x then
    local gap = math.floor(random(y, to_y))
    return Hedge(x, y, x, gap), Hedge(x, gap + 1, x, to_y)
  end
  local gap = math.floor(random(x, to_x))
  return Hedge(x, y, gap, y), Hedge(gap + 1, y, to_x, y)
end)
garden:interpret("Hedge(x, y, to_x, to_y)", function(this, x, y, to_x, to_y)
  if x ~= to_x or y ~= to_y then
    local size = vec(to_x - x, to_y - y, 0) * PATH + vec(THICK, THICK, HIGH)
    local body = cuboid(size.x, size.y, size.z):translate(vec(x * PATH - THICK / 2, y * PATH - THICK / 2, 0))
    this:shape(body:chamfer(0.1), mix(hedge, "#7d9a4e", choose({ 0, 0.1, 0.2 })))
  end
end)

-- Around the maze: a lawn, a path, a brick wall with piers, and round bushes.
local plan = rectangle(columns * PATH, rows * PATH)
garden:interpret("Garden", function(this)
  this:shape(plan:offset(5)[1]:extrude(-0.5), "#7b9350")
  this:shape(plan:offset(1.6)[1]:translate(vec(0, 0, 0.02)), "#d9cbaa")
  this:shape(cuboid(PATH, 6, 0.02):translate(vec((cx + 1) * PATH, -6, 0.01)), "#d9cbaa")
  local corners = plan:offset(4)[1]:points()
  local parts: { any } = {}
  for number, corner in corners do
    local next = corners[number % 4 + 1]
    local pieces = 2 * math.round(corner:distance(next) / 8) + 1
    for piece = 0, pieces - 1 do
      local from, to = lerp(corner, next, piece / pieces), lerp(corner, next, (piece + 1) / pieces)
      table.insert(parts, Pier(from))
      table.insert(parts, Wall(from, to))
      if piece > 0 then
        table.insert(parts, Bush(lerp(from, plan:center(), 0.07)))
      end
    end
  end
  return sequence(parts)
end)
-- The wall is open in the middle of the south side.
garden:interpret("Wall(from, to)", function(this, from, to)
  if from.y < 0 and to.y < 0 and math.abs(lerp(from, to, 0.5).x - plan:center().x) < 1 then
    return
  end
  local profile = shape({ { -0.15, 0 }, { 0.15, 0 }, { 0.15, 2 }, { -0.15, 2 } })
  local coping = shape({ { -0.22, 2 }, { 0.22, 2 }, { 0, 2.18 } })
  this:shape(profile:sweep({ from, to }), "#a8614a")
  this:shape(coping:sweep({ from, to }), "#cfc6b4")
end)
garden:interpret("Pier(place)", function(this, place)
  this:shape(cuboid(0.5, 0.5, 2.3):translate(place - vec(0.25, 0.25, 0)), "#98553f")
  this:shape(rectangle(0.64, 0.64):translate(place + vec(-0.32, -0.32, 2.3)):taper(0.4, 0.2), "#cfc6b4")
end)
garden:interpret("Bush(place)", function(this, place)
  this:shape(cylinder(0.07, 0.6, 8):translate(place), "#6b5138")
  this:shape(ball(0.5, 24):translate(place + vec(0, 0, 0.95)):smooth(), mix(hedge, "#7d9a4e", 0.3))
end)
garden:interpret("Fountain", function(this)
  local stone = { color = "#c9c2b2" }
  this:jump({ (cx + 1.5) * PATH, (cy + 1.5) * PATH, 0 }):material(stone)
  this:scale(1.9):extrude(0.4):color("#4b8fa3"):scale(1.7):extrude(0.02)
  this:material(stone):scale(0.35):taper(0.2):extrude(0.9):scale(0.3):taper(1):extrude(0.25)
  this:color("#4b8fa3"):scale(0.9):extrude(0.02)
  this:material(stone):scale(0.16):extrude(0.5):scale(0.2):taper(0.5):extrude(0.15)
  this:shape(ball(0.15):translate(vec(0, 0, 0.1)))
end)
garden:derive()
local middle, far = plan:center(), math.max(columns / 19, rows / 15)
camera({
  name = "gate",
  from = middle + far * vec(-11, -42, 35),
  to = middle + far * vec(0.8, -2.5, 0),
  fov = 41,
})
