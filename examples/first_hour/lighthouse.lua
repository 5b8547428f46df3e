--!strict
-- A lighthouse on a rock in the sea, with a keeper's cottage that stands on the terrain.
local bands =
  param("bands", { default = 7, min = 3, max = 15, step = 1, doc = "Number of red and white bands" })
local relief = param("relief", { default = 9, min = 6, max = 20, unit = "m", doc = "Height of the rock" })

-- The rock: a formula gives the height at the centre of each cell, above and below the sea.
local function form(x: number, y: number): number
  local reach = vec(x * 0.75, y, 0):length() / 24 + 0.25 * noise(x / 12, y / 12)
  local cliff = 1 - ease.smooth(math.clamp(reach * 1.25 - 0.5, 0, 1))
  local crags = 3 * math.abs(noise(x / 5, y / 5, 3)) + 1.6 * math.abs(noise(x / 2, y / 2, 7))
  return -6 + (relief + 6) * cliff + crags - 1.2
end
local Cell = module("Cell", "height", "form", "x", "y", "width")
local cells = lsystem()
cells:axiom(Cell(0, 0, 0, 0, 120))
cells:rule("Cell(height, form, x, y, width)", function(this, _, _, x: number, y: number, width: number)
  local q, half = width / 4, width / 2
  return Cell(0, form(x - q, y + q), x - q, y + q, half),
    Cell(0, form(x + q, y + q), x + q, y + q, half),
    Cell(0, form(x - q, y - q), x - q, y - q, half),
    Cell(0, form(x + q, y - q), x + q, y - q, half)
end)

local Terrace = module("Terrace", "area", "height")
local cottage = polygon({ { -14, -5 }, { -6.5, -5 }, { -6.5, 0 }, { -14, 0 } })
local land = lsystem({
  object = terrain({
    size = 120,
    levels = 8,
    rules = cells,
    base = -14,
    color = "#6b645c",
    covers = {
      { color = "#6b645c" },
      { color = "#76884e", on = { height = { 6, 8 }, slope = { 34, 24 }, noise = 0.3 } },
      { color = "#474540", on = { height = { 1.4, 0.5 } } },
    },
    water = { level = 0, clarity = 3 },
  }),
})
land:axiom(Terrace(point(0, 0):buffer(5), relief - 1), Terrace(cottage:buffer(1), relief - 2))
land:interpret("Terrace(area, height)", function(this, area, height)
  this:flatten(area, height, 3)
end)
local ground: Terrain = land:derive(0).objects[1]

-- The tower: each band is a little narrower than the one below.
local TAPER = 0.94
local Band, Wall = module("Band", "number", "radius"), module("Wall", "radius", "color")
local Gallery, Lantern = module("Gallery", "radius"), module("Lantern", "radius")
local tower =
  lsystem({ object = extruder({ sides = 40, position = { 0, 0, relief - 1.4 }, roughness = 0.5 }) })
tower:axiom(Band(1, 3.2))
tower:rule("Band(number, radius)", function(this, number: number, radius: number)
  local color = if number % 2 == 1 then "#f1ece2" else "#b93a2c"
  if number == bands then
    return Wall(radius, color), Gallery(radius), Lantern(radius * 0.7)
  end
  return Wall(radius, color), Band(number + 1, radius * TAPER)
end)
tower:interpret("Wall(radius, color)", function(this, radius, color)
  this:color(color):scale(radius):taper(radius * TAPER):extrude(2.7)
end)
tower:interpret("Gallery(radius)", function(this, radius)
  this:color("#f1ece2"):scale(radius):taper(radius * 1.5):extrude(0.8)
  this:color("#38393c"):scale(radius * 1.55):extrude(0.2)
  local low = this:position()
  for number = 1, 20 do
    local turn = math.rad(18 * number)
    this:jump(low + radius * 1.47 * vec(math.cos(turn), math.sin(turn), 0)):scale(0.05):extrude(1.1)
  end
  for rail = 0, 1 do
    local ring = disk(0.05, 8):sweep(disk(radius * 1.47, 40):points(), { closed = true })
    this:jump(low + vec(0, 0, 0.6 + 0.5 * rail)):shape(ring)
  end
  this:jump(low)
end)
tower:interpret("Lantern(radius)", function(this, radius)
  this:color("#f1ece2"):scale(radius):extrude(0.7)
  local low = this:position()
  this:material({ color = "#ffe9a8", emissive = "#e8b64a" }):scale(radius * 0.85):extrude(1.9)
  this:material({ color = "#b93a2c", roughness = 0.4 }):scale(radius * 1.25):taper(radius * 1.2):extrude(0.15)
  for ring = 0, 7 do
    local from, to = math.rad(11 * ring), math.rad(11 * ring + 11)
    this:scale(1.2 * radius * math.cos(from)):taper(1.2 * radius * math.cos(to))
    this:extrude(0.75 * radius * (math.sin(to) - math.sin(from)))
  end
  this:color("#38393c"):scale(0.06):extrude(1.6)
  for number = 1, 12 do
    local turn = math.rad(30 * number)
    this:jump(low + radius * 0.92 * vec(math.cos(turn), math.sin(turn), 0)):scale(0.06):extrude(1.9)
  end
end)
tower:derive()

-- The cottage: a window or more in each wall.
local pane = panel({ material = { color = "#2d3a44", roughness = 0.1 }, width = 0.9, height = 1.1 })
local window =
  bordered(extruded(pane, { depth = -0.15 }), { left = 0.7, right = 0.7, bottom = 0.9, top = 0.4 })
local windows = facade({ template({ wall = grid(window, { rows = 1 }) }) })
local House = module("House")
local house = lsystem({ object = footprint(cottage, { ground = ground, color = "#ece5d6" }) })
house:axiom(House())
house:interpret("House", function(this)
  this:groundwork("extruded", { color = "#77716a" }):walls({ height = 2.8, templates = windows })
  this:roof({ kind = "gable", slope = 42, overhang = 0.4, slab = 0.18, color = "#7d4a3a" })
end)
house:derive()
-- The camera shows the whole tower, however high it is.
local far = math.max(1, (relief + 2.7 * bands) / 28)
camera({ name = "boat", from = far * vec(-46, -60, 26), to = far * vec(-1, 0, 9.8), fov = 37 })
camera({ name = "shore", from = { -38, -52, 17 }, to = { -3, 0, 12.5 } })
