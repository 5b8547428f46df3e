--!strict
-- A rendered house of a suburb or a village, with shuttered windows and a tiled roof.
local parts = require("templates/parts")
local walls = require("templates/walls")

local RENDERS = { "#e4d9c4", "#d9c6a5", "#e6e2d8", "#d8b99a", "#cfd0c4" }
local SHUTTERS = { "#6f858f", "#77836a", "#8a6055", "#5f6f7a", "#7a6a58" }

local window = parts.window({ width = 1.05, height = 1.4, rows = 2 })
local slim = parts.window({ width = 0.6, height = 1.0, columns = 1 })
local chimney = parts.chimney({ width = 0.8, depth = 0.6, height = 0.9, color = "#c7a58c", pots = 2 })

local function make(color: string, shutter: string, kind: string)
  local render, base = walls.surface(color), walls.surface(mix(color, "#8a8478", 0.3))
  local trim = walls.surface(mix(color, "#ffffff", 0.35))
  local door = parts.door({ width = 1.05, height = 2.15, color = shutter, glass = true })
  local open = parts.surround({
    width = 1.05,
    height = 1.4,
    jamb = 0.08,
    head = 0.12,
    out = 0.03,
    material = trim,
    shutters = shutter,
  })
  local framed =
    parts.surround({ width = 0.6, height = 1.0, jamb = 0.08, head = 0.1, out = 0.03, material = trim })
  local portal = parts.portal({ width = 1.05, height = 2.15, jamb = 0.14, head = 0.16, material = trim })
  local bay = walls.bay(
    walls.opening({ width = 1.05, height = 1.4, depth = 0.18, model = window, surround = open, reveal = trim }),
    { side = 0.75, sill = 0.85, top = 0.15, width = { 2.55, 3, 4.8 } }
  )
  local narrow = walls.bay(
    walls.opening({ width = 0.6, height = 1.0, depth = 0.18, model = slim, surround = framed, reveal = trim }),
    { side = 0.25, sill = 1.1, top = 0.12 }
  )
  local entry = walls.bay(
    walls.opening({
      width = 1.05,
      height = 2.15,
      depth = 0.22,
      model = door,
      surround = portal,
      at = "bottom",
      open = true,
    }),
    { side = 0.3, sill = 0, top = 0.17, width = { 1.65, 1.9, 2.8 } }
  )
  local tiles = walls.surface("#b0836a", "tiles")
  return {
    name = "villa",
    storey = 2.8,
    ground = 2.9,
    walls = {
      ground = walls.storey({ bay = bay, narrow = narrow, entry = entry, material = render, party = base }),
      upper = walls.storey({ bay = bay, narrow = narrow, material = render, party = base }),
    },
    groundwork = base,
    roof = {
      kind = kind,
      slope = 32,
      overhang = 0.5,
      eaves = "open",
      slab = 0.15,
      material = tiles,
      gable = render,
      trim = trim,
      details = { { model = chimney, on = "ridge", every = 30, margin = 1, count = 1 } },
    },
    wide = { kind = "hip", slope = 18, overhang = 0.4, slab = 0.15, material = tiles, trim = trim },
  }
end

local variants = {}
for index, render in RENDERS do
  table.insert(variants, make(render, SHUTTERS[index], if index % 2 == 0 then "hip" else "gable"))
end
return variants
