--!strict
-- A slab of flats: the front has loggias with balustrades, the other sides have windows behind reveals.
local elements = require("@elements")
local bays, openings, cornices = elements.bays, elements.openings, elements.cornices
local Mass, Storey = module("Mass", "shape"), module("Storey", "shape")
local Front, Wall = module("Front", "shape"), module("Wall", "shape")
local Loggia, Roof = module("Loggia", "shape"), module("Roof", "shape")

local function draw(shapes: { Shape }): ...any
  local modules = {}
  for at, part in shapes do
    modules[at] = Draw(part)
  end
  return table.unpack(modules)
end

local slab = lsystem({ object = extruder({ color = "#d9d4c8" }) })
local mass = cuboid(42, 11, 24.6)
expect(math.round(mass:volume() * 1000) / 1000, 11365.2)
slab:axiom(Mass(mass))
slab:rule("Mass(s)", function(this, s: Shape)
  return split(s, "z", { { 3.6, Storey }, { { "~2.9", Storey } }, { 0.6, Roof } })
end)
slab:rule("Storey(s)", function(this, s: Shape)
  return components(s, "faces", { { "front", Front }, { "side", Wall } })
end)
slab:rule("Front(s)", function(this, s: Shape)
  return split(s, "x", { { 0.3, Draw }, { { "~4.6", Loggia }, { 0.3, Draw } } })
end)
-- An open room with a window in its back, and a railing.
slab:rule("Loggia(s)", function(this, s: Shape)
  local window = { width = 3, height = 2, sill = 0.08, columns = 3, rows = 1, bench = 0, surround = 0 }
  return draw(bays.loggia(s, { window = window, inside = "#d3ccbc" }))
end)
slab:rule("Wall(s)", function(this, s: Shape)
  local function bay(part: Shape)
    return draw(openings.window(part, { width = 1.3, height = 1.4, rows = 1, surround = 0 }))
  end
  return split(s, "x", { { "~1", Draw }, { 2, bay }, { "~2", Draw }, { 2, bay }, { "~1", Draw } })
end)
-- The upper side, and a low storey for lifts.
slab:rule("Roof(s)", function(this, s: Shape)
  return Draw(s),
    Draw(s:faces("up")[1]:crop(15, 3, 9, 5):extrude(2.6):color("#b9b4a8")),
    draw(
      cornices.cornice(
        s:faces("up")[1],
        { profile = "fillet", height = 0.35, depth = 0.08, color = "#8f8b82" }
      )
    )
end)
slab:derive()

camera({ from = vec(-16, -38, 9), to = vec(20, 4, 11.5), fov = 44 })
