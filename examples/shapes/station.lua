--!strict
-- A country station: courses of stone that meet at the corners, a pantile roof cut at its hips, caps along ridges and hips,
-- a gutter swept around the eaves, and the name over the door.
local name = param("name", { default = "São Bento", doc = "Name of the station." })
local Mass, Wall, Course = module("Mass", "shape"), module("Wall", "shape"), module("Course", "face")
local Roof, Slope, Cap, Sign =
  module("Roof", "shape"), module("Slope", "face"), module("Cap", "edge"), module("Sign", "wall")
local station = lsystem({ object = extruder({ color = "#e9e2d0", roughness = 0.9 }) })
local wide, deep, high = 15, 8, 4.6

station:axiom(
  Mass(cuboid(wide, deep, high)),
  Roof(rectangle(wide, deep):translate(vec(0, 0, high)):roof({ kind = "hip", slope = 32, overhang = 0.6 }))
)
station:rule("Mass(s)", function(this, s: Shape)
  return Draw(s), components(s, "faces", { { "side", Wall } })
end)
station:rule("Wall(s)", function(this, s: Shape)
  local function opening(part: Shape)
    local whole = part:offset(-0.02)[1]
    local frame = part:molding({ { -0.02, 0 }, { 0.14, 0 }, { 0.14, 0.05 }, { 0.02, 0.08 }, { -0.02, 0.08 } })
    return Draw(frame:color("#c2b69a")), Draw(whole:shift(vec(0, 0, 0.01)):color("#3d4f4a"))
  end
  local function bays(part: Shape)
    return split(
      part,
      "x",
      { { "~1", false }, { { "~0.6", false }, { 1.2, opening }, { "~0.6", false } }, { "~1", false } }
    )
  end
  local parts =
    split(s, "y", { { 0.8, Course }, { 0.2, false }, { 2, bays }, { "~1", false }, { 0.35, Course } })
  if s:matches("front") then
    return Sign(s), parts
  end
  return parts
end)
station:rule("Course(face)", function(this, face: Shape)
  local function band(part: Shape)
    local size = part:size()
    local longer = part:resize(vec(size.x + 1, size.y - 0.03, 0)):shift(vec(-0.5, 0.015, 0))
    local stone = longer:extrude(0.12):trim_to(part)
    return if stone then Draw(stone:color("#a89c84")) else nil
  end
  return split(face, "y", { { { "~0.4", band } } })
end)
-- The name, upright on the wall, above the openings.
station:rule("Sign(wall)", function(this, wall: Shape)
  local letters = text(name, { size = 0.4, align = "center", spacing = 0.06 }):extrude(0.05)
  local middle = wall:center() + wall:y_axis() * (high / 2 - 0.8)
  local upright = letters:align():rotate(90, vec(1, 0, 0))
  return Draw(upright:translate(middle - upright:center() - vec(0, 0.03, 0)):color("#24364a"))
end)

station:rule("Roof(s)", function(this, s: Shape)
  local function any(edge: Shape)
    return edge:matches("ridge") or edge:matches("hip")
  end
  local eaves = s:faces("down")[1]:points()
  local gutter: { Vector } = {}
  for _, at in eaves do
    table.insert(gutter, at)
  end
  local channel = shape({
    { -0.08, 0.06 },
    { -0.08, -0.02 },
    { -0.05, -0.07 },
    { 0.05, -0.07 },
    { 0.08, -0.02 },
    { 0.08, 0.06 },
  })
  return Draw(s:color("#d9d2c2")),
    components(s, "faces", { { "slanted", Slope } }),
    components(s, "edges", { { any, Cap } }),
    Draw(channel:sweep(gutter, { closed = true }):color("#6f7a78"))
end)
-- One section of pantiles over the whole width, swept from the eave to the ridge and cut at the hips.
station:rule("Slope(face)", function(this, face: Shape)
  local size = face:size()
  local count = math.ceil(size.x / 0.3) + 2
  local section = { { -0.3, 0.0 } }
  section[2] = { (count - 1) * 0.3, 0.0 }
  for step = count * 6 - 6, -6, -1 do
    table.insert(section, { step * 0.05, 0.06 + 0.035 * math.sin(step / 6 * 2 * math.pi) })
  end
  local from = face:position() - face:y_axis() * 0.05
  local path = { from, face:position() + face:y_axis() * size.y }
  local tiles = shape(section):sweep(path):smooth(50):trim_to(face)
  return if tiles then Draw(tiles:color("#a5543a")) else nil
end)
station:rule("Cap(edge)", function(this, edge: Shape)
  local cap = disk(0.14, 16):translate(vec(0, 0.05, 0))
  return Draw(cap:sweep(edge):smooth():color("#8f4630"))
end)
station:derive()
