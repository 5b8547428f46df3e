--!strict
-- Houses on a slope: the terrain is derived first, then each house stands on its ground, and the garden is level.
local relief = param("relief", { default = 16, min = 0, max = 40, unit = "m", doc = "Height of the hill" })

-- The height of the ground is a formula here: each cell takes the height at its centre.
local function form(x: number, y: number): number
  return relief * (0.5 - 0.5 * math.cos(math.rad(1.4 * y + 90))) + 2.5 * noise(x / 30, y / 30)
end
local Cell = module("Cell", "height", "form", "x", "y", "width")
local cells = lsystem()
cells:axiom(Cell(0, 0, 0, 0, 120))
cells:rule("Cell(height, form, x, y, width)", function(this, _, _, x: number, y: number, width: number)
  local q = width / 4
  return Cell(0, form(x - q, y + q), x - q, y + q, width / 2),
    Cell(0, form(x + q, y + q), x + q, y + q, width / 2),
    Cell(0, form(x - q, y - q), x - q, y - q, width / 2),
    Cell(0, form(x + q, y - q), x + q, y - q, width / 2)
end)

local plots = {}
for number = 0, 4 do
  local x, y = -48 + 21 * number, -16 + 13 * (number % 3)
  table.insert(
    plots,
    { id = `house {number}`, plan = { { x, y }, { x + 12, y + 1 }, { x + 11.5, y + 9 }, { x - 0.5, y + 8 } } }
  )
end

local Terrace = module("Terrace", "shape")
local land = lsystem({
  object = terrain({
    size = 120,
    levels = 7,
    rules = cells,
    base = -11,
    covers = { { color = "#84965a" }, { color = "#8d7f68", on = { slope = { 26, 34 } } } },
  }),
})
local terraces = {}
for _, plot in plots do
  table.insert(terraces, Terrace(polygon(plot.plan):buffer(2)))
end
land:axiom(sequence(terraces))
land:interpret("Terrace(shape)", function(this, shape)
  this:flatten(shape, nil, 6)
end)
local ground: Terrain = land:derive(0).objects[1]

local House = module("House")
local houses = lsystem({ object = footprint })
houses:axiom(source(plots), function(plot)
  return footprint(plot.plan, { ground = ground, color = choose({ "#e6dac4", "#d6b69a", "#e9e5da" }) }),
    House()
end)
houses:interpret("House", function(this)
  this:groundwork("extruded", { color = "#8b867d" }):walls({ height = 5.4 })
  this:roof({
    kind = "gable",
    slope = 40,
    overhang = 0.6,
    slab = 0.2,
    color = "#93503d",
    trim = { color = "#efe8d9" },
  })
end)
houses:derive()
