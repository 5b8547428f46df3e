--!strict
-- A timber-framed house: a ground floor of stone, and above it oak frames with plaster between them, under a steep
-- gable. Each storey projects over the storey below.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box: (...any) -> any, beam: (...any) -> any = parts.box, parts.beam

local PLASTERS = { "#e6dcc4", "#dcc79c", "#d3a98b", "#e4e0d6", "#c6c5a8" }
local TILES = { "#bb8e78", "#c79b80", "#a98271", "#a08d80", "#cba086" }
local OAKS = { "#4a3526", "#3d2c22", "#54392a", "#3a3330", "#4a3526" }

local chimney = parts.chimney({
  width = 0.9,
  depth = 0.7,
  height = 1.2,
  material = walls.surface("#a06a52", "brick"),
  pots = 1,
})

-- The frame of a bay of about 2 m by 2.7 m: posts, rails and braces around a window.
local function frame(oak, braces: string)
  local y0, y1 = -0.05, 0.02
  local shapes = {
    box(oak, -1, -0.91, y0, y1, 0.22, 2.52),
    box(oak, 0.91, 1, y0, y1, 0.22, 2.52),
    box(oak, -1, 1, y0 - 0.05, y1, 0, 0.22),
    box(oak, -1, 1, y0 - 0.03, y1, 2.52, 2.7),
    box(oak, -0.63, -0.5, y0, y1, 0.22, 2.52),
    box(oak, 0.5, 0.63, y0, y1, 0.22, 2.52),
    box(oak, -0.91, -0.63, y0 + 0.005, y1, 1.35, 1.47),
    box(oak, 0.63, 0.91, y0 + 0.005, y1, 1.35, 1.47),
    -- The ends of the joists below.
    box(oak, -0.6, -0.42, y0 - 0.12, y1, 0.02, 0.17),
    box(oak, 0.42, 0.6, y0 - 0.12, y1, 0.02, 0.17),
  }
  local d = y0 + 0.015
  if braces == "cross" then
    table.insert(shapes, beam(oak, { -0.48, 0.22 }, { 0.48, 0.84 }, 0.12, d, y1))
    table.insert(shapes, beam(oak, { 0.48, 0.22 }, { -0.48, 0.84 }, 0.12, d + 0.01, y1))
  else
    table.insert(shapes, beam(oak, { -0.93, 0.24 }, { -0.55, 1.38 }, 0.11, d, y1))
    table.insert(shapes, beam(oak, { 0.93, 0.24 }, { 0.55, 1.38 }, 0.11, d, y1))
    table.insert(shapes, box(oak, -0.05, 0.05, d, y1, 0.22, 0.84))
  end
  return parts.model(shapes)
end

-- The frame of a gable: a tie beam, a collar beam, posts and braces around a window. The gable is plaster.
local function attic(oak)
  local y0, y1 = -0.06, 0.03
  return parts.model(
    box(oak, -2.6, 2.6, y0 - 0.02, y1, -0.3, -0.1),
    box(oak, -1.6, 1.6, y0 - 0.01, y1, 1.3, 1.48),
    box(oak, -0.52, -0.4, y0, y1, -0.1, 1.3),
    box(oak, 0.4, 0.52, y0, y1, -0.1, 1.3),
    box(oak, -0.06, 0.06, y0, y1, 1.48, 2.6),
    beam(oak, { -2.0, -0.1 }, { -1.1, 1.3 }, 0.12, y0 + 0.01, y1),
    beam(oak, { 2.0, -0.1 }, { 1.1, 1.3 }, 0.12, y0 + 0.01, y1),
    beam(oak, { -1.15, -0.1 }, { -0.46, 0.85 }, 0.11, y0 + 0.015, y1),
    beam(oak, { 1.15, -0.1 }, { 0.46, 0.85 }, 0.11, y0 + 0.015, y1),
    box(oak, -0.4, 0.4, y0, y1, 0.14, 0.24),
    box(parts.glass, -0.4, 0.4, -0.02, y1, 0.24, 1.3),
    box(oak, -0.025, 0.025, -0.04, 0, 0.24, 1.3),
    box(oak, -0.4, 0.4, -0.035, 0, 0.75, 0.79)
  )
end

local function make(color: string, oak_color: string, tile_color: string, braces: string)
  local oak = walls.surface(oak_color)
  local plaster = walls.surface(color)
  local stone = walls.surface("#b5ab9a", "rubble")
  local window =
    parts.window({ width = 0.9, height = 1.15, color = oak_color, columns = 2, rows = 3, frame = 0.06 })
  local slim =
    parts.window({ width = 0.5, height = 0.9, color = oak_color, columns = 1, rows = 3, frame = 0.05 })
  local door = parts.door({ width = 1.15, height = 2.15, color = mix(oak_color, "#7a5a3a", 0.4), wings = 1 })
  local shop =
    parts.window({ width = 1.7, height = 1.5, color = oak_color, columns = 4, rows = 3, frame = 0.09 })
  local trim = parts.surround({ width = 0.9, height = 1.15, jamb = 0.09, head = 0.1, material = oak })
  local door_trim =
    parts.portal({ width = 1.15, height = 2.15, jamb = 0.2, head = 0.24, out = 0.08, material = oak })
  local shop_trim =
    parts.surround({ width = 1.7, height = 1.5, jamb = 0.12, head = 0.16, out = 0.06, material = oak })

  local pane =
    walls.opening({ width = 0.9, height = 1.15, depth = 0.08, model = window, surround = trim, reveal = oak })
  local bay = extruded(walls.bay(pane, { side = 0.3, sill = 0.95, width = { 1.55, 1.95, 2.7 } }), {
    model = frame(oak, braces),
    stretch = true,
  })
  local low = walls.bay(pane, { side = 0.45, sill = 1, width = { 1.8, 2.4, 3.6 } })
  local narrow = walls.bay(
    walls.opening({ width = 0.5, height = 0.9, model = slim, reveal = oak }),
    { side = 0.2, sill = 1.1 }
  )
  local display = walls.bay(
    walls.opening({
      width = 1.7,
      height = 1.5,
      depth = 0.16,
      model = shop,
      surround = shop_trim,
      reveal = oak,
    }),
    { side = 0.3, sill = 0.75, width = { 2.3, 2.6, 4 } }
  )
  local entry = walls.bay(
    walls.opening({
      width = 1.15,
      height = 2.15,
      depth = 0.25,
      model = door,
      surround = door_trim,
      at = "bottom",
      open = true,
    }),
    { side = 0.3, sill = 0, top = 0.28, width = { 1.75, 1.9, 2.6 } }
  )
  local party = walls.surface("#c9c0ae")
  local function upper(jut: number)
    return walls.storey({ bay = bay, narrow = narrow, jut = jut, material = plaster, party = party })
  end
  local tiles = walls.surface(tile_color, "tiles")
  return {
    name = "half_timbered",
    storey = 2.7,
    ground = 2.8,
    walls = {
      ground = walls.storey({
        bay = low,
        narrow = narrow,
        street = display,
        entry = entry,
        aside = true,
        material = stone,
        party = stone,
      }),
      upper = upper(0.28),
      high = upper(0.5),
    },
    pick = function(number: number): string
      return if number == 1 then "ground" elseif number == 2 then "upper" else "high"
    end,
    groundwork = stone,
    roof = {
      kind = "gable",
      party_gables = false,
      slope = 50,
      overhang = 0.75,
      eaves = "open",
      slab = 0.18,
      material = tiles,
      gable = plaster,
      trim = oak,
      underside = oak,
      details = {
        { model = chimney, on = "ridge", every = 50, margin = 1.2, count = 1 },
        { model = attic(oak), on = "gable", offset = 0.35, margin = 0 },
      },
    },
    wide = { kind = "hip", slope = 38, overhang = 0.7, slab = 0.15, material = tiles, trim = oak },
  }
end

local variants = {}
for index, plaster in PLASTERS do
  table.insert(
    variants,
    make(plaster, OAKS[index], TILES[index], if index % 2 == 0 then "cross" else "leaning")
  )
end
return variants
