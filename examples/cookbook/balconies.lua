--!strict
-- A block of flats with balconies: a facade grammar with models on its walls.
local storeys = param("storeys", { default = 7, min = 2, max = 20, step = 1, doc = "Number of storeys" })

-- A balcony: x to the right, z up, and y into the wall, so it juts out along -y.
local Balcony = module("Balcony")
local smithy = lsystem({ object = extruder({ smooth = false }) })
smithy:axiom(Balcony())
smithy:interpret("Balcony", function(this)
  this:jump({ 0, -0.7, 0 }):rectangle(2.8, 1.4):color("#d6d0c4"):extrude(0.15)
  this:color("#4b5157"):rectangle(0.05, 0.05)
  for number = 0, 14 do
    this:jump({ -1.35 + number * 2.7 / 14, -1.37, 0.15 }):extrude(0.95)
  end
  for _, x in { -1.37, 1.37 } do
    for number = 0, 5 do
      this:jump({ x, -1.37 + number * 0.25, 0.15 }):extrude(0.95)
    end
  end
  this:jump({ 0, -1.37, 1.1 }):rectangle(2.84, 0.07):extrude(0.06)
end)
local balcony = smithy:derive()

local glass = { color = "#37474f", roughness = 0.08 }
local frame = { color = "#f3efe6" }
local door = bordered(panel({ material = glass, width = { 1.8, 2, 2.2 }, height = { 2.2, 2.3, 2.4 } }), {
  left = { 0.08, "fixed" },
  right = { 0.08, "fixed" },
  top = { 0.08, "fixed" },
  material = frame,
})
local loggia = extruded(bordered(extruded(door, { depth = -0.15 }), { left = 0.4, right = 0.4, top = 0.5 }), {
  depth = 0,
  model = balcony,
  at = "bottom",
})
local pane = panel({ material = glass, width = { 1, 1.2, 1.5 }, height = { 1.5, 1.6, 1.7 } })
local window = bordered(
  extruded(pane, { depth = -0.15, material = frame }),
  { left = 0.5, right = 0.5, bottom = 0.85, top = 0.5 }
)
local storey = list({ window, loggia, window, window, loggia, window }, { height = { 2.9, 3, 3.2 } })

local House = module("House")
local plan = { { 0, 0 }, { 19, 0 }, { 19, 11 }, { 0, 11 } }
local house =
  lsystem({ object = footprint(plan, { edge_keywords = { [2] = { "side" }, [4] = { "side" } } }) })
house:axiom(House())
house:interpret("House", function(this)
  local plaster = { color = "#d98f5f" }
  local side = template({ wall = grid(window), keywords = { "side" }, material = plaster })
  local front = template({
    wall = list(
      { grid(window, { rows = 1, height = { 3, 3.4 } }), grid(storey) },
      { direction = "vertical" }
    ),
    material = plaster,
  })
  this:walls({ height = 3 * storeys, templates = { front, side } })
  this:roof({ kind = "flat", border = 0.8, color = "#8f8c86", trim = { color = "#efe9dd" } })
end)
house:derive()
