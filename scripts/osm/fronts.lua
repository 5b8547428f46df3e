--!strict
-- Simple facades for buildings of any height: rows of windows on walls of one material.
local parts = require("templates/parts")
local walls = require("templates/walls")
local fronts = {}

local door = parts.door({ width = 1.1, height = 2.2, color = "#6b5038", glass = true })
local tall = parts.window({ width = 1.1, height = 1.5, color = "#e9e6de", columns = 2 })
local wide = parts.window({ width = 1.7, height = 1.5, color = "#5a5f62", columns = 3 })

-- A facade of bays; `is_wide` selects wider windows. Fronts with the keyword "entry door" have a door.
function fronts.of(material: any, is_wide: boolean): Facade
  local opening = walls.opening({
    width = if is_wide then 1.7 else 1.1,
    height = 1.5,
    depth = 0.12,
    model = if is_wide then wide else tall,
  })
  local bay = bordered(opening, {
    left = 0.6,
    right = 0.6,
    bottom = { 0.75, "max" },
    top = 0.4,
    width = if is_wide then { 2.9, 3.3, 6 } else { 2.3, 2.8, 4.7 },
    height = { 2.65, 3.1, 5.4 },
  })
  local entry =
    bordered(walls.opening({ width = 1.1, height = 2.2, depth = 0.12, model = door, open = true }), {
      left = 0.5,
      right = 0.5,
      top = 0.4,
      width = { 2.1, 2.3, 4 },
      height = { 2.65, 3.1, 5.4 },
    })
  local row = grid(bay, { rows = 1 })
  local ground = list({ row, entry, row })
  local words = { "entry door" }
  return facade({
    template(panel({}), { material = material, weight = 0 }),
    template(panel({}), { keywords = { "blind" }, material = material }),
    template(grid(bay), { material = material }),
    template(ground, { keywords = words, material = material }),
    template(
      list({ ground, grid(bay) }, { direction = "vertical" }),
      { keywords = words, material = material }
    ),
  })
end

return fronts
