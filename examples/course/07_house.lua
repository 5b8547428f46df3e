--!strict
-- A house: walls from a grammar of windows, a door, and a roof with dormers and a chimney.
local storeys = param("storeys", { default = 2, min = 1, max = 6, step = 1, doc = "Number of storeys" })
local slope = param("slope", { default = 42, min = 15, max = 60, unit = "deg", doc = "Slope of the roof" })

-- Materials.
local plaster = { color = "#e9dfc9" }
local stone = { color = "#b9ad98" }
local wood = { color = "#f4f0e6" }
local glass = { color = "#31424c", roughness = 0.08 }
local tiles = { color = "#9c4a35", roughness = 0.9 }

-- A window: four panes of glass between bars, in a frame that stands back from the wall.
local pane = bordered(
  panel({ material = glass }),
  { left = 0.035, right = 0.035, top = 0.035, bottom = 0.035, material = wood }
)
local panes = grid(pane, { columns = 2, rows = 2, width = { 1, 1.15, 1.4 }, height = { 1.35, 1.45, 1.6 } })
local frame = bordered(extruded(panes, { depth = -0.16, material = wood }), {
  left = 0.1,
  right = 0.1,
  top = 0.1,
  bottom = 0.14,
  material = stone,
})
local window = bordered(frame, { left = 0.5, right = 0.5, bottom = 0.85, top = 0.3 })
local storey = grid(window, { rows = 1, height = { 2.7, 2.9, 3.2 } })

-- A door with a window on each side of it.
local leaf = panel({ material = { color = "#3f5b52" }, width = { 1.2, 1.2 }, height = { 2.2, 2.2 } })
local door = bordered(extruded(leaf, { depth = -0.25, material = stone }), {
  left = { 0.15, "fixed" },
  right = { 0.15, "fixed" },
  top = { 0.15, "fixed" },
  material = stone,
})
local entry = bordered(door, { left = 0.5, right = 0.5, top = 0.3 })
local ground = list(
  { grid(window, { rows = 1 }), entry, grid(window, { rows = 1 }) },
  { height = { 2.7, 3.2 } }
)

local facades = facade({
  template({ wall = grid(storey), material = plaster }),
  template({
    wall = if storeys == 1 then ground else list({ ground, grid(storey) }, { direction = "vertical" }),
    keywords = { "entry door" },
    material = plaster,
  }),
})

-- Models for the roof: a chimney, and a dormer.
local Chimney, Dormer = module("Chimney"), module("Dormer")
local masonry = lsystem({ object = extruder({ smooth = false, color = "#9a5f49" }) })
masonry:axiom(Chimney())
masonry:interpret("Chimney", function(this)
  this:rectangle(0.7, 0.9):extrude(2.3):rectangle(0.85, 1.05):extrude(0.14)
end)
local chimney = masonry:derive()

local carpentry = lsystem({ object = extruder({ smooth = false }) })
carpentry:axiom(Dormer())
carpentry:interpret("Dormer", function(this)
  -- The front of a model looks towards -y. The section is drawn in x and z, and swept along y into the roof.
  this:direction({ 0, 1, 0 }, { 0, 0, 1 }):jump({ 0, -0.5, 0 })
  this
    :polygon({ { -0.75, -1 }, { 0.75, -1 }, { 0.75, 1.2 }, { 0, 1.75 }, { -0.75, 1.2 } })
    :material(plaster)
    :extrude(2.6)
  this
    :jump({ 0, -0.55, 0 })
    :polygon({ { -0.45, 0.15 }, { 0.45, 0.15 }, { 0.45, 1.1 }, { -0.45, 1.1 } })
    :material(glass)
    :extrude(0.1)
  this:jump({ 0, -0.7, 0 }):material(tiles)
  this
    :polygon({ { -1, 1.05 }, { -0.95, 0.95 }, { 0, 1.68 }, { 0.95, 0.95 }, { 1, 1.05 }, { 0, 1.85 } })
    :extrude(2.8)
end)
local dormer = carpentry:derive()

local House = module("House")
local Plinth, Walls, Roof = module("Plinth"), module("Walls", "height"), module("Roof")

local plan = { { 0, 0 }, { 15, 0 }, { 15, 9 }, { 10, 9 }, { 10, 13 }, { 4, 13 }, { 4, 9 }, { 0, 9 } }
local house = lsystem({ object = footprint(plan) })
house:axiom(House())
house:rule("House", function(this)
  return Plinth(), Walls(2.9 * storeys), Roof()
end)
house:interpret("Plinth", function(this)
  this:walls({ height = 0.5, material = stone })
end)
house:interpret("Walls(height)", function(this, height)
  this:walls({ height = height, templates = facades })
end)
house:interpret("Roof", function(this)
  this:roof({
    kind = "gable",
    slope = slope,
    overhang = 0.5,
    eaves = "open",
    slab = 0.18,
    material = tiles,
    trim = wood,
    gable = plaster,
    details = {
      { model = chimney, on = "ridge", count = 2, every = 6, margin = 2, sink = 1.2 },
      { model = dormer, on = "slope", every = 4, offset = 1.5, margin = 1.5, count = 4 },
    },
  })
end)
house:derive()
