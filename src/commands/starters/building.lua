--!strict
-- A house with windows, a door and a roof. Change a number, save, and watch the live view.
local storeys = param("storeys", { default = 3, min = 1, max = 12, step = 1 })
local width = param("width", { default = 16, min = 6, max = 60, unit = "m" })
local depth = param("depth", { default = 10, min = 6, max = 40, unit = "m" })
local kind = param("roof", { default = "hip", choices = { "flat", "gable", "hip", "mansard" } })

-- A wall is a grammar: glass, a recess around it, margins around that, and a row of these.
local glass = panel({
  material = { color = "#3a4d59", roughness = 0.1 },
  width = { 1, 1.2, 1.5 },
  height = { 1.5, 1.6, 1.7 },
})
local window =
  bordered(extruded(glass, { depth = -0.2 }), { left = 0.5, right = 0.5, bottom = 0.8, top = 0.5 })
local storey = grid(window, { rows = 1, height = { 2.8, 3, 3.3 } })

local leaf = panel({ material = { color = "#5b3d2a" }, width = { 1.3, 1.3 }, height = { 2.3, 2.3 } })
local door = bordered(extruded(leaf, { depth = -0.3 }), { left = 0.5, right = 0.5, top = 0.5 })
local ground = list(
  { grid(window, { rows = 1 }), door, grid(window, { rows = 1 }) },
  { height = { 2.8, 3.3 } }
)

local plaster = { color = "#e6dac2" }
local front = if storeys == 1 then ground else list({ ground, grid(storey) }, { direction = "vertical" })
local facades = facade({
  template({ wall = grid(storey), material = plaster }),
  template({ wall = front, keywords = { "entry door" }, material = plaster }),
})

local House = module("House")
local Walls = module("Walls", "height")
local Roof = module("Roof", "kind")

local house = lsystem({ object = footprint({ { 0, 0 }, { width, 0 }, { width, depth }, { 0, depth } }) })

house:axiom(House())

house:rule("House", function(this)
  return Walls(3 * storeys), Roof(kind)
end)

house:interpret("Walls(height)", function(this, height)
  this:walls({ height = height, templates = facades })
end)

house:interpret("Roof(kind)", function(this, kind)
  this:roof({
    kind = kind,
    height = if kind == "flat" then nil else 3.5,
    overhang = if kind == "flat" then 0 else 0.6,
    slab = if kind == "flat" then 0 else 0.2,
    border = if kind == "flat" then 0.8 else 0,
    color = if kind == "flat" then "#a9a69f" else "#96493a",
    trim = { color = "#f1ebdd" },
  })
end)

house:derive()
