--!strict
-- A simple building, as in CGA's first tutorial: a mass on a lot, storeys, tiles with windows, and a door in the front.
local facade = require("elements/facade")
local Mass, Storey = module("Mass", "shape"), module("Storey", "shape")
local Wall, Front = module("Wall", "shape"), module("Front", "shape")
local Tile, Opening = module("Tile", "shape"), module("Opening", "shape")

local lot = shape({ { 0, 0 }, { 18, 0 }, { 18, 12 }, { 0, 12 } })
local mass = lot:setback(1)[1]:extrude(13)
expect(math.round(mass:volume() * 1000) / 1000, 16 * 10 * 13)
expect(mass:open_edges(), 0)

local house = lsystem({ object = extruder({ color = "#c9b18c" }) })
house:axiom(Draw(lot:color("#8b9a72")), Mass(mass))
house:rule("Mass(s)", function(this, s: Shape)
  local roof = s:faces("top")[1]:roof({ kind = "hip", overhang = 0.4 }):color("#7c4436")
  return Draw(roof), split(s, "z", { { 4, Storey }, { { "~3", Storey } } })
end)
house:rule("Storey(s)", function(this, s: Shape)
  local front = if s:index() == 1 then Front else Wall
  return components(s, "faces", { { "front", front }, { "side", Wall } })
end)
house:rule("Front(s)", function(this, s: Shape)
  local function door(part: Shape)
    local function leaf(opening: Shape)
      return Draw(opening:shift(vec(0, 0, -0.1)):color("#4a3426"))
    end
    return split(part, "y", { { 2.6, leaf }, { "~1", Draw } })
  end
  return split(s, "x", { { "~1", Wall }, { 2, door }, { "~1", Wall } })
end)
house:rule("Wall(s)", function(this, s: Shape)
  return split(s, "x", { { { "~2.6", Tile } } })
end)
house:rule("Tile(s)", function(this, s: Shape)
  local function column(part: Shape)
    return split(part, "y", { { 0.9, Draw }, { "~1", Opening }, { 0.6, Draw } })
  end
  return split(s, "x", { { "~1", Draw }, { 1.2, column }, { "~1", Draw } })
end)
house:rule("Opening(s)", function(this, s: Shape)
  local modules = {}
  for at, part in facade.window(s, 0.2, 0.07) do
    modules[at] = Draw(part)
  end
  return table.unpack(modules)
end)
house:derive()
