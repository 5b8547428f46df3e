--!strict
-- A facade, translated from CityEngine: extrude, comp, split and repeat become walls of a grammar.
local height = param("height", { default = 21, min = 7, max = 60, unit = "m", doc = "attr height" })

local brick, trim, glass =
  { color = "#a8644c" }, { color = "#e8dfcd" }, { color = "#37474f", roughness = 0.08 }

-- Window --> s(...) t(0, 0, -0.2) color(glass)
local window = extruded(
  panel({ material = glass, width = { 1, 1.2, 1.6 }, height = { 1.5, 1.8, 2 } }),
  { depth = -0.2, material = trim }
)
-- Tile --> split(x) { ~0.6: Wall | 1.2: split(y) { 0.9: Wall | 1.8: Window | ~0.4: Wall } | ~0.6: Wall }
local tile = bordered(window, { left = 0.5, right = 0.5, bottom = 0.8, top = 0.4 })
-- Floor --> split(x) { ~2.4: Tile }*
local floor = grid(tile, { rows = 1, height = { 3, 3.2, 3.6 } })
-- Ledge --> a band that juts out
local ledge = extruded(panel({ material = trim, height = { 0.35, 0.35 } }), { depth = 0.25, material = trim })
-- Shop --> split(x) { ~3: ShopWindow }*
local shop = grid(
  bordered(
    extruded(panel({ material = glass, width = { 2, 2.6, 3.4 }, height = { 2.6, 2.8, 3 } }), { depth = -0.3 }),
    {
      left = 0.25,
      right = 0.25,
      bottom = { 0.4, "fixed" },
      top = { 0.5, "fixed" },
      material = trim,
    }
  ),
  { rows = 1, height = { 3.5, 3.9 } }
)
-- Facade --> split(y) { 3.8: Shop | 0.35: Ledge | { ~3.2: Floor }* | 0.35: Ledge }
local front = list({ shop, ledge, grid(floor), ledge }, { direction = "vertical" })

-- Lot --> extrude(height) comp(f) { front: Facade | side: Side | top: Roof }
local Lot = module("Lot")
local lot = lsystem({
  object = footprint(
    { { 0, 0 }, { 16, 0 }, { 16, 11 }, { 9, 11 }, { 9, 15 }, { 0, 15 } },
    { color = "#a8644c" }
  ),
})
lot:axiom(Lot())
lot:interpret("Lot", function(this)
  this:walls({ height = height, templates = { template({ wall = front, material = brick }) } })
  this:roof({ kind = "mansard", height = 4, overhang = 0.3, slab = 0.2, color = "#565d66", trim = trim })
end)
lot:derive()
