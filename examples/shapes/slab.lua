--!strict
-- A slab of flats: the front has loggias with balustrades, the other sides have windows behind reveals.
local facade = require("elements/facade")
local Mass, Storey = module("Mass", "shape"), module("Storey", "shape")
local Front, Wall = module("Front", "shape"), module("Wall", "shape")
local Loggia, Opening = module("Loggia", "shape"), module("Opening", "shape")

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
  return split(s, "z", { { 3.6, Storey }, { { "~2.9", Storey } }, { 0.6, Draw } })
end)
slab:rule("Storey(s)", function(this, s: Shape)
  return components(s, "faces", { { "front", Front }, { "side", Wall } })
end)
slab:rule("Front(s)", function(this, s: Shape)
  return split(s, "x", { { 0.3, Draw }, { { "~4.6", Loggia }, { 0.3, Draw } } })
end)
-- A room without a front, 1.6 m deep: floor, ceiling, sides and a back with a window.
slab:rule("Loggia(s)", function(this, s: Shape)
  local back = s:shift(vec(0, 0, -1.6))
  local room = back:extrude(1.6):joined_faces("tag:extrude.side") :: Shape
  local shapes = facade.balustrade(s:shift(vec(0, 0, -0.1)), 1.05, 0.12)
  return Draw(room:reverse()),
    split(back, "x", { { "~1", Draw }, { 3, Opening }, { "~1", Draw } }),
    draw(shapes)
end)
slab:rule("Wall(s)", function(this, s: Shape)
  local function bay(part: Shape)
    return split(part, "y", { { 0.9, Draw }, { "~1", Opening }, { 0.5, Draw } })
  end
  return split(s, "x", { { "~1", Draw }, { 1.3, bay }, { "~2", Draw }, { 1.3, bay }, { "~1", Draw } })
end)
slab:rule("Opening(s)", function(this, s: Shape)
  return draw(facade.window(s, 0.18, 0.08))
end)
slab:derive()
