--!strict
-- A warehouse: bays between piers with steel windows, gates on the street, and a low roof with skylights; of brick
-- with a gambrel roof, or of ribbed metal with a shed roof.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box = parts.box

local light = parts.model({
  box(parts.steel, -0.7, 0.7, -1.3, 1.3, -0.1, 0.12),
  box(parts.clear_glass, -0.62, 0.62, -1.22, 1.22, 0.12, 0.15),
})

local function make(color: string, image: string, kind: string, gate_color: string)
  local face = walls.surface(color, image, if image == "ribs" then 0.55 else nil)
  local brick = image == "brick"
  local trim = walls.surface(if brick then "#c8bda8" else "#5d666c")
  local steel = if brick then "#3d4a44" else "#4a5359"
  local high = if brick then 2.1 else 1.1
  local window = parts.window({
    width = 2.4,
    height = high,
    color = steel,
    columns = 5,
    rows = if brick then 4 else 2,
    frame = 0.06,
  })
  local small =
    parts.window({ width = 0.8, height = 1.2, color = steel, columns = 2, rows = 3, frame = 0.05 })
  local gate = parts.gate({ width = 3.2, height = 3.4, color = gate_color })
  local door = parts.door({ width = 1.1, height = 2.2, color = steel })
  local sill = parts.surround({ width = 2.4, height = high, head = 0.22, ears = 0.1, material = trim })

  local pier = extruded(panel({ width = { 0.25, 0.25 } }), { depth = if brick then 0.16 else 0.08 })
  local function between(wall)
    return list({ pier, wall, pier })
  end
  local opening = walls.opening({ width = 2.4, height = high, depth = 0.16, model = window, surround = sill })
  local bay =
    between(walls.bay(opening, { side = 0.3, sill = if brick then 1.2 else 2.4, width = { 3, 3.7, 6 } }))
  local narrow =
    walls.bay(walls.opening({ width = 0.8, height = 1.2, model = small }), { side = 0.25, sill = 1.4 })
  local loading =
    between(walls.bay(walls.opening({ width = 3.2, height = 3.4, depth = 0.3, model = gate, open = true }), {
      side = 0.25,
      sill = 0,
      width = { 3.7, 4.2, 6.5 },
    }))
  local entry =
    walls.bay(walls.opening({ width = 1.1, height = 2.2, depth = 0.2, model = door, open = true }), {
      side = 0.3,
      sill = 0,
      width = { 1.7, 1.9, 3 },
    })
  local course = walls.cornice({ { 0.18, 0.2 } }, trim)
  local metal = walls.surface(if brick then "#7d746c" else "#9aa1a5", "ribs", 0.5)
  return {
    name = "warehouse",
    storey = 4,
    ground = 4.6,
    walls = {
      ground = walls.storey({
        bay = bay,
        narrow = narrow,
        street = loading,
        entry = entry,
        head = course,
        material = face,
      }),
      upper = walls.storey({ bay = bay, narrow = narrow, head = course, material = face }),
    },
    groundwork = walls.surface("#8a8880"),
    roof = {
      kind = kind,
      slope = if kind == "shed" then 7 else 24,
      overhang = 0.35,
      slab = 0.2,
      material = metal,
      gable = face,
      trim = trim,
      details = { { model = light, on = "slope", every = 4.5, margin = 2.5, tilt = true } },
    },
    wide = { kind = "flat", border = 0.8, material = walls.surface("#85827b"), trim = trim },
  }
end

return {
  make("#a07468", "brick", "gambrel", "#5f6d66"),
  make("#b9c0c2", "ribs", "shed", "#5a6c7d"),
  make("#ab9079", "brick", "gable", "#6e5049"),
  make("#7f97a3", "ribs", "gable", "#c9c5ba"),
}
