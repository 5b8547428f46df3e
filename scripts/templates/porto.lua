--!strict
-- A merchant's house from Porto: narrow and high, with glazed tiles between granite frames, iron balconies in front
-- of French windows, and a low tiled roof.
local parts = require("templates/parts")
local walls = require("templates/walls")

local FACES = {
  { "#9fb0c6", "azulejo" },
  { "#d2b47c", nil },
  { "#cdd8c4", "azulejo" },
  { "#b07763", nil },
  { "#e4e0d4", nil },
  { "#e2cf9a", "azulejo" },
}
local DOORS = { "#3a5546", "#5e3a35", "#3d4f63", "#45423d", "#40616a", "#6b543f" }

local window = parts.window({ width = 1.05, height = 2.2, color = "#ece9e1", rows = 4 })
local slim = parts.window({ width = 0.6, height = 1.8, color = "#ece9e1", columns = 1, rows = 3 })
local chimney = parts.chimney({ width = 0.7, depth = 0.7, height = 0.9, color = "#d8d0c0", pots = 1 })
local dormer = parts.dormer({
  width = 1.4,
  height = 1.3,
  depth = 2.2,
  color = "#e0dbd0",
  kind = "gable",
  slope = 0.5,
  rows = 2,
  roof = walls.surface("#a8735a"),
})

local granite = walls.surface("#a9a398")
local blocks = walls.surface("#a39d92", "ashlar")
local balcony = parts.balcony({
  width = 1.05,
  height = 2.2,
  depth = 0.42,
  side = 0.26,
  jamb = 0.16,
  slab = 0.17,
  material = granite,
})
local frame = parts.surround({ width = 1.05, height = 2.2, jamb = 0.16, head = 0.17, material = granite })
local small_frame =
  parts.surround({ width = 0.6, height = 1.8, jamb = 0.12, head = 0.15, material = granite })

local function make(face: any, door_color: string)
  local tiles = walls.surface(face[1], face[2], 0.45)
  local door = parts.door({ width = 1.15, height = 2.75, color = door_color, wings = 2, transom = 0.6 })
  local gate = parts.shop({ width = 1.9, height = 2.75, color = door_color, sign = "#e4dcc8" })
  local width = { 1.85, 2.6, 3.4 }
  local function french(surround)
    return walls.opening({
      width = 1.05,
      height = 2.2,
      depth = 0.2,
      model = window,
      surround = surround,
      reveal = granite,
    })
  end
  local bay = walls.bay(french(balcony), { side = 0.32, sill = 0.22, top = 0.22, width = width })
  local back = walls.bay(french(frame), { side = 0.32, sill = 0.3, top = 0.22, width = width })
  local narrow = walls.bay(
    walls.opening({
      width = 0.6,
      height = 1.8,
      depth = 0.2,
      model = slim,
      surround = small_frame,
      reveal = granite,
    }),
    { side = 0.2, sill = 0.55 }
  )
  local shop =
    walls.bay(walls.opening({ width = 1.9, height = 2.75, depth = 0.25, model = gate, open = true }), {
      side = 0.25,
      sill = 0,
      width = { 2.4, 2.6, 4 },
    })
  local entry = walls.bay(
    walls.opening({ width = 1.15, height = 2.75, depth = 0.3, model = door, open = true }),
    { side = 0.25, sill = 0, width = { 1.6, 1.8, 2.4 } }
  )
  local course = walls.cornice({ { 0.1, 0.06 }, { 0.1, 0.12 } }, granite)
  local cornice = walls.cornice({ { 0.16, 0.08 }, { 0.12, 0.22 }, { 0.08, 0.32 } }, granite)
  local party = walls.surface("#b9b2a5")
  local trim = walls.surface("#d9d2c4")
  local roof = walls.surface("#b88468", "tiles")
  return {
    name = "porto",
    storey = 3.05,
    ground = 3.4,
    walls = {
      ground = walls.storey({
        bay = back,
        narrow = narrow,
        street = shop,
        entry = entry,
        aside = true,
        head = course,
        material = blocks,
        party = party,
      }),
      upper = walls.storey({ bay = back, narrow = narrow, street = bay, material = tiles, party = party }),
      top = walls.storey({
        bay = back,
        narrow = narrow,
        street = bay,
        head = cornice,
        material = tiles,
        party = party,
      }),
    },
    pick = function(number: number, levels: number): string
      return if number == 1 then "ground" elseif number == levels then "top" else "upper"
    end,
    groundwork = blocks,
    roof = {
      kind = "hip",
      slope = 25,
      overhang = 0.35,
      slab = 0.12,
      material = roof,
      trim = trim,
      details = {
        { model = dormer, on = "slope", every = 60, margin = 2.4, offset = 1, chance = 0.4 },
        { model = chimney, on = "ridge", every = 30, margin = 0.6, chance = 0.8, count = 1 },
      },
    },
    wide = { kind = "hip", slope = 14, overhang = 0.35, slab = 0.12, material = roof, trim = trim },
  }
end

local variants = {}
for index, face in FACES do
  table.insert(variants, make(face, DOORS[index]))
end
return variants
