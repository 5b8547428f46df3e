--!strict
-- A Victorian terrace house: brick with white lintels, sash windows, a canted bay next to the door, slates and
-- chimneys; and a variant without the bay, which would overlap the sidewalk if there is no garden in front of the
-- house.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box: (...any) -> any, prism: (...any) -> any = parts.box, parts.prism

local BRICKS = { "#a9796a", "#b39478", "#94716a" }
local DOORS = { "#24405c", "#6b2226", "#2f4d3a" }

local sash = parts.sash({ width = 1.0, height = 1.65 })
local slim = parts.sash({ width = 0.6, height = 1.5, columns = 1 })
local chimney = parts.chimney({
  width = 1.7,
  depth = 0.6,
  height = 1.3,
  pots = 4,
  material = walls.surface("#a17666", "brick"),
  across = true,
})

local function make(color: string, door_color: string, has_bow: boolean)
  local brick = walls.surface(color, "brick")
  local white = parts.painted("#e9e5da")
  local slate = walls.surface("#565d66", "slates")
  local lintel =
    parts.surround({ width = 1.0, height = 1.65, head = 0.22, ears = 0.14, out = 0.04, material = white })
  local small_lintel = parts.surround({ width = 0.6, height = 1.5, head = 0.2, ears = 0.1, material = white })
  local door = parts.door({ width = 1.0, height = 2.55, color = door_color, transom = 0.45 })
  local portal =
    parts.portal({ width = 1.0, height = 2.55, jamb = 0.2, head = 0.28, out = 0.16, material = white })

  -- The plan of the bay at a distance of `e` (m) from its walls.
  local function plan(e: number)
    return { { -1.2 - e, 0.02 }, { -0.72 - e, -0.7 - e }, { 0.72 + e, -0.7 - e }, { 1.2 + e, 0.02 } }
  end
  local canted = {
    prism(brick, plan(0), 0, 0.72),
    prism(white, plan(0.06), 0.72, 0.82),
    prism(parts.glass, plan(-0.08), 0.82, 2.42),
    prism(white, plan(0.02), 2.42, 2.62),
    prism(white, plan(0.12), 2.62, 2.72),
    prism(slate, plan(-0.02), 2.72, 2.8),
    prism(slate, plan(-0.22), 2.8, 2.88),
    box(white, -0.62, 0.62, -0.69, -0.6, 1.6, 1.66),
  }
  for _, x in { -0.7, -0.05, 0.6 } do
    table.insert(canted, box(white, x, x + 0.1, -0.7, -0.55, 0.82, 2.42))
  end
  for side = -1, 1, 2 do
    table.insert(canted, box(white, side * 1.13 - 0.07, side * 1.13 + 0.07, -0.12, 0.02, 0.82, 2.42))
  end
  local bow = panel({ model = parts.model(canted), at = "bottom", width = { 2.7, 2.7 }, surface = "window" })
  local bow_bay = bordered(bow, { left = 0.2, right = 0.2, width = { 3.1, 3.4, 5 } })

  local bay = walls.bay(
    walls.opening({
      width = 1.0,
      height = 1.65,
      depth = 0.12,
      model = sash,
      surround = lintel,
      reveal = white,
    }),
    { side = 0.4, sill = 0.75, width = { 1.8, 2.3, 3.6 } }
  )
  local narrow = walls.bay(
    walls.opening({
      width = 0.6,
      height = 1.5,
      depth = 0.12,
      model = slim,
      surround = small_lintel,
      reveal = white,
    }),
    { side = 0.25, sill = 0.8 }
  )
  local entry = walls.bay(
    walls.opening({
      width = 1.0,
      height = 2.55,
      depth = 0.3,
      model = door,
      surround = portal,
      at = "bottom",
      open = true,
    }),
    { side = 0.35, sill = 0, top = 0.32, width = { 1.8, 2, 2.6 } }
  )
  local course = walls.cornice({ { 0.08, 0.04 }, { 0.08, 0.08 } }, white)
  local eaves = walls.cornice({ { 0.15, 0.05 }, { 0.12, 0.12 } }, white)
  return {
    name = "terrace_house",
    storey = 2.95,
    ground = 3.25,
    walls = {
      ground = walls.storey({
        bay = bay,
        narrow = narrow,
        street = if has_bow then bow_bay else nil,
        entry = entry,
        aside = true,
        head = course,
        material = brick,
      }),
      upper = walls.storey({ bay = bay, narrow = narrow, material = brick }),
      top = walls.storey({ bay = bay, narrow = narrow, head = eaves, material = brick }),
    },
    pick = function(number: number, levels: number): string
      return if number == 1 then "ground" elseif number == levels then "top" else "upper"
    end,
    groundwork = brick,
    roof = {
      kind = "gable",
      slope = 36,
      overhang = 0.25,
      eaves = "slab",
      slab = 0.12,
      material = slate,
      gable = brick,
      trim = white,
      details = { { model = chimney, on = "ridge", every = 6.4, margin = 0.5, sink = 0.1 } },
    },
    wide = { kind = "hip", slope = 22, overhang = 0.25, slab = 0.12, material = slate, trim = white },
  }
end

local houses = { bowed = {}, plain = {} }
for index, brick in BRICKS do
  table.insert(houses.bowed, make(brick, DOORS[index], true))
  table.insert(houses.plain, make(brick, DOORS[index], false))
end
return houses
