--!strict
-- A simple building, as in CGA's first tutorial: a mass on a lot, storeys, tiles with windows, and a door in the front.
local elements = require("@elements")
local openings, cornices, roofs = elements.openings, elements.cornices, elements.roofs
local Mass, Base, Storey, Front, Wall, Tile, Roof =
  module("Mass", "shape"),
  module("Base", "shape"),
  module("Storey", "shape"),
  module("Front", "shape"),
  module("Wall", "shape"),
  module("Tile", "shape"),
  module("Roof", "plan")

local lot = shape({ { 0, 0 }, { 20, 0 }, { 20, 15 }, { 0, 15 } })
local mass = lot:setback({ front = 3, side = 2 })[1]:extrude(10.4)
expect(math.round(mass:volume() * 1000) / 1000, 1664)
expect(mass:open_edges(), 0)

local house = lsystem({ object = extruder({ color = "#d9c8a6" }) })
local function draw(shapes: { any }): any
  local parts: { any } = {}
  for at, part in shapes do
    parts[at] = Draw(part)
  end
  return sequence(parts)
end

house:axiom(
  Draw(lot:extrude(-0.2):color("#8b9a72")),
  Mass(mass),
  draw(elements.stairs.podium(rectangle(2.4, 1.2):translate(vec(8.8, 1.9, 0)), { height = 0.7 }))
)
house:rule("Mass(s)", function(this, s: Shape)
  return Roof(s:faces("top")[1]), split(s, "z", { { 0.7, Base }, { 3.5, Storey }, { { "~3", Storey } } })
end)
house:rule("Base(s)", function(this, s: Shape)
  local around = s:faces("down")[1]:reverse()
  return draw(cornices.cornice(around, { profile = "plinth", height = 0.7, depth = 0.14, color = "#a99f8c" }))
end)
-- Walls, and a band above each storey.
house:rule("Storey(s)", function(this, s: Shape)
  local front = if s:index() == 2 then Front else Wall
  local walls = components(s, "faces", { { "front", front }, { "side", Wall } })
  if s:index() == s:count() then
    return walls
  end
  local top = s:faces("up")[1]:translate(vec(0, 0, -0.2))
  return walls, draw(cornices.cornice(top, { profile = "string", height = 0.22, depth = 0.12 }))
end)
house:rule("Front(s)", function(this, s: Shape)
  local function door(part: Shape)
    return draw(openings.door(part, { kind = "round", height = 2.7, light = 0.7, keystone = true, step = 0 }))
  end
  return split(s, "x", { { "~1", Wall }, { 2.8, door }, { "~1", Wall } })
end)
house:rule("Wall(s)", function(this, s: Shape)
  return split(s, "x", { { { "~2.6", Tile } } })
end)
house:rule("Tile(s)", function(this, s: Shape)
  local kind = if s:size().y > 3.2 then "segmental" else "rectangle"
  return draw(openings.window(s, { kind = kind, height = s:size().y - 1.5, sill = 0.8 }))
end)
-- A cornice, a hip roof with a dormer, and chimneys at its ends.
house:rule("Roof(plan)", function(this, plan: Shape)
  local eaves = plan:translate(vec(0, 0, 0.35))
  local size = plan:size()
  local front = plan:extrude(2.2):faces("front")[1]:shift(vec(0, 1.35, -1.2))
  local shapes: { any } = { eaves:roof({ kind = "hip", slope = 40, overhang = 0.5 }):color("#7c4436") }
  for _, part in cornices.cornice(plan, { profile = "cyma", height = 0.35, depth = 0.4 }) do
    table.insert(shapes, part)
  end
  for _, part in roofs.dormer(front, { tiles = "#7c4436", wall = "#d9c8a6", depth = 3 }) do
    table.insert(shapes, part)
  end
  for _, x in { 0.2, 0.8 } do
    local stack = plan:crop(size.x * x - 0.5, size.y / 2 + 0.6, 1, 0.6)
    for _, part in if stack then roofs.chimney(stack, { height = 5.2 }) else {} do
      table.insert(shapes, part)
    end
  end
  return draw(shapes)
end)
house:derive()

camera({ from = vec(-7, -22, 6.5), to = vec(10.5, 6, 5.2), fov = 40 })
