--!strict
-- Templates for stone walls: few narrow windows, taller ones above.
local materials = require("./materials")

local dark = panel({ material = materials.void, width = { 0.45, 0.6, 0.8 }, height = { 1.2, 1.7, 2.4 } })

-- A window between splayed jambs, above a sill of dressed stone.
local function lancet(side: number, sill: number)
  local framed = bordered(extruded(dark, { depth = -0.45 }), {
    left = { 0.18, "fixed" },
    right = { 0.18, "fixed" },
    bottom = { 0.2, "fixed" },
    top = { 0.28, "fixed" },
    material = materials.dressed,
  })
  return bordered(extruded(framed, { depth = 0.06, material = materials.dressed }), {
    left = side,
    right = side,
    bottom = sill,
    top = 0.7,
  })
end

local course = extruded(panel({ material = materials.dressed, height = { 0.3, 0.3 } }), { depth = 0.12 })

-- Storeys of lancets with string courses between them, above a ground floor without windows.
local function wall(bay: number)
  local storey = list({
    grid(lancet(bay / 2, 1.1), { rows = 1, height = { 3.2, 3.8, 4.6 } }),
    course,
  }, { direction = "vertical" })
  local blind = panel({ height = { 2.4, 3 } })
  return list({ blind, course, grid(storey, { columns = 1 }) }, { direction = "vertical" })
end

return {
  -- A facade for footprints; `bay` is the width (m) of the wall between two windows.
  facade = function(bay: number)
    return facade({
      template({ wall = wall(bay), material = materials.ashlar }),
      template({ wall = panel({}), material = materials.ashlar, weight = 0.001 }),
    })
  end,
}
