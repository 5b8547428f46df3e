--!strict
-- An Alpine chalet: a white ground floor, boards and a carved balcony above, and a low roof with a wide overhang.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box: (...any) -> any = parts.box

local WOODS = { "#8f6c4d", "#775d48", "#9b7c5c" }
local SHUTTERS = { "#566f5a", "#7d4b45", "#54687a" }
local FLOWERS = { "#b8323a", "#c74f6b", "#c9652f" }

local chimney = parts.chimney({ width = 0.8, depth = 0.8, height = 1.1, color = "#d6d0c4", pots = 0 })

local function make(color: string, shutter: string, flowers: string)
  local wood = walls.surface(color, "boards")
  local beam = parts.matt(mix(color, "#2a1a10", 0.35))
  local render = walls.surface("#e8e2d5")
  local window = parts.window({ width = 1.1, height = 1.25, color = mix(color, "#ffffff", 0.1), rows = 2 })
  local tall = parts.window({ width = 1.2, height = 2.05, color = mix(color, "#ffffff", 0.1), rows = 2 })
  local small = parts.window({ width = 0.6, height = 0.9, color = mix(color, "#ffffff", 0.1), columns = 1 })
  local door = parts.door({ width = 1.1, height = 2.1, color = mix(color, "#2a1a10", 0.2), glass = true })
  local shuttered = parts.surround({
    width = 1.1,
    height = 1.25,
    jamb = 0.08,
    head = 0.1,
    material = beam,
    shutters = shutter,
    pots = flowers,
  })
  local framed =
    parts.surround({ width = 1.1, height = 1.25, jamb = 0.1, head = 0.12, material = beam, pots = flowers })
  local door_frame = parts.portal({ width = 1.1, height = 2.1, jamb = 0.12, head = 0.16, material = beam })

  -- Boards with small gaps, a rail, and joists below.
  local balcony = { box(beam, -1.3, 1.3, -1.1, 0, 0.04, 0.14) }
  for joist = -1, 1 do
    table.insert(balcony, box(beam, joist * 0.87 - 0.08, joist * 0.87 + 0.08, -1.15, 0, -0.16, 0.04))
  end
  for board = 0, 12 do
    local x = -1.2 + 0.2 * board
    table.insert(balcony, box(beam, x - 0.085, x + 0.085, -1.1, -1.07, 0.16, 1.02))
  end
  table.insert(balcony, box(beam, -1.3, 1.3, -1.16, -1.04, 1.0, 1.09))
  table.insert(balcony, box(parts.matt(flowers), -1.1, 1.1, -1.32, -1.16, 0.95, 1.12))
  table.insert(balcony, box(parts.matt("#4e6b35"), -1.15, 1.15, -1.34, -1.16, 0.8, 0.95))
  table.insert(balcony, box(beam, -1.3, 1.3, -0.04, 0.02, 2.66, 2.7))
  local gallery = parts.model(balcony)

  local low = walls.bay(
    walls.opening({ width = 1.1, height = 1.25, depth = 0.2, model = window, surround = shuttered }),
    { side = 0.75, sill = 0.9, width = { 2.6, 3, 4.6 } }
  )
  local narrow =
    walls.bay(walls.opening({ width = 0.6, height = 0.9, model = small }), { side = 0.25, sill = 1.1 })
  local bay = walls.bay(
    walls.opening({ width = 1.1, height = 1.25, depth = 0.12, model = window, surround = framed }),
    { side = 0.5, sill = 0.8, width = { 2.1, 2.6, 4.2 } }
  )
  local french = walls.bay(
    walls.opening({ width = 1.2, height = 2.05, depth = 0.12, model = tall }),
    { side = 0.5, sill = 0.14, width = { 2.2, 2.6, 4.4 } }
  )
  local entry = walls.bay(
    walls.opening({
      width = 1.1,
      height = 2.1,
      depth = 0.25,
      model = door,
      surround = door_frame,
      at = "bottom",
      open = true,
    }),
    { side = 0.4, sill = 0, width = { 1.9, 2.1, 3 } }
  )
  local sill = walls.band(0.22, 0.08, beam)
  local function upper(street)
    return walls.storey({
      bay = bay,
      narrow = narrow,
      street = street,
      foot = sill,
      material = wood,
      party = wood,
    })
  end
  return {
    name = "chalet",
    storey = 2.7,
    ground = 2.8,
    walls = {
      ground = walls.storey({
        bay = low,
        narrow = narrow,
        entry = entry,
        aside = true,
        material = render,
        party = render,
      }),
      upper = upper(extruded(french, { model = gallery, stretch = true })),
    },
    groundwork = walls.surface("#9a948a", "rubble"),
    roof = {
      kind = "gable",
      slope = 24,
      overhang = 1.5,
      eaves = "open",
      slab = 0.22,
      material = walls.surface("#6e665e", "slates"),
      gable = wood,
      trim = beam,
      underside = beam,
      details = { { model = chimney, on = "ridge", every = 50, margin = 2.5, sink = 0.1, count = 1 } },
    },
  }
end

local variants = {}
for index, color in WOODS do
  table.insert(variants, make(color, SHUTTERS[index], FLOWERS[index]))
end
return variants
