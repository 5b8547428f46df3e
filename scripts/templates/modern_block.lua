--!strict
-- A block of flats: white render, loggias with coloured backs behind glass, and a flat roof.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box = parts.box

local RENDERS = { "#e9e7e1", "#e3ded2", "#dfe2e0" }
local ACCENTS = { "#b48d68", "#7d8a79", "#8f6f66" }

local stairs = parts.model({
  box(parts.matt("#d8d6d0"), -1.8, 1.8, -1.6, 1.6, 0, 2.3),
  box(parts.matt("#8b8d8c"), -1.9, 1.9, -1.7, 1.7, 2.3, 2.45),
})

local function make(color: string, accent: string)
  local render, back = walls.surface(color), walls.surface(accent)
  local grey = walls.surface("#a2a39f")
  local window = parts.window({ width = 1.7, height = 1.45, color = "#5a5f62", columns = 3 })
  local french = parts.window({ width = 2.0, height = 2.1, color = "#5a5f62", columns = 2 })
  local slim = parts.window({ width = 0.7, height = 1.45, color = "#5a5f62", columns = 1 })
  local rail = parts.loggia({ width = 3.2, height = 2.5 })

  local inner =
    walls.bay(walls.opening({ width = 2.0, height = 2.1, depth = 0.1, model = french, open = true }), {
      side = 0.3,
      sill = 0.03,
      top = 0.1,
      width = { 2.6, 3.1, 4.2 },
      material = back,
    })
  local loggia =
    bordered(extruded(inner, { depth = -1.4, model = rail, stretch = true, material = render }), {
      left = 0.15,
      right = 0.15,
      bottom = { 0.14, "fixed" },
      top = { 0.12, "fixed" },
    })
  local pane = walls.opening({ width = 1.7, height = 1.45, depth = 0.16, model = window })
  local flat = walls.bay(pane, { side = 0.4, sill = 0.85, width = { 2.5, 2.9, 4 } })
  local narrow = walls.bay(
    walls.opening({ width = 0.7, height = 1.45, depth = 0.16, model = slim }),
    { side = 0.25, sill = 0.85 }
  )
  local dark = { color = "#4d5254", roughness = 0.5 }
  local canopy = parts.model({
    box(dark, -1.2, -1.12, 0, 0.1, 0, 2.4),
    box(dark, 1.12, 1.2, 0, 0.1, 0, 2.4),
    box(dark, -1.12, 1.12, 0, 0.1, 2.3, 2.4),
    box(parts.glass, -1.12, 1.12, 0.04, 0.07, 0, 2.3),
    box(dark, -0.04, 0.04, 0, 0.1, 0, 2.3),
    box(parts.steel, 0.1, 0.14, -0.06, -0.02, 0.9, 1.3),
    box(back, -1.2, 1.2, -1.9, 0, 2.4, 2.55),
  })
  local entry = walls.bay(
    walls.opening({ width = 2.4, height = 2.55, depth = 0.5, model = canopy, open = true, reveal = back }),
    {
      side = 0.4,
      sill = 0,
      top = 0.1,
      width = { 3.1, 3.4, 4.2 },
      material = back,
    }
  )
  local pair = list({ loggia, flat })
  local edge = walls.band(0.16, 0.05, grey)
  return {
    name = "modern_block",
    storey = 2.85,
    ground = 3,
    walls = {
      ground = walls.storey({
        bay = flat,
        narrow = narrow,
        entry = entry,
        head = edge,
        material = grey,
        party = render,
      }),
      upper = walls.storey({ bay = pair, narrow = { narrow, flat }, material = render, party = render }),
    },
    groundwork = grey,
    roof = {
      kind = "flat",
      border = 0.6,
      border_width = 0.3,
      material = walls.surface("#8e8d88"),
      trim = render,
      details = { { model = stairs, on = "slope", every = 14, margin = 4, count = 2 } },
    },
  }
end

local variants = {}
for index, render in RENDERS do
  table.insert(variants, make(render, ACCENTS[index]))
end
return variants
