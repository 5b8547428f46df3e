--!strict
-- An office block behind a curtain wall: storeys of glass between slim fins, a recessed entrance hall, and machines
-- on the flat roof.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box = parts.box

local GLASSES = { "#8ba3ae", "#6f8894", "#9fb0b2" }
local FRAMES = { "#aeb4b7", "#3c4246", "#c9c4b8" }

local machine = parts.model({
  box(parts.matt("#8c9194"), -3, 3, -1.8, 1.8, 0, 2.2),
  box(parts.iron, -2.7, 2.7, -1.83, -1.8, 0.4, 1.8),
  box(parts.matt("#777c80"), -1.6, -0.4, -0.6, 0.6, 2.2, 2.6),
  box(parts.matt("#777c80"), 0.5, 1.7, -0.6, 0.6, 2.2, 2.6),
})

local function make(tint: string, frame_color: string)
  local frame = { color = frame_color, roughness = 0.4, metallic = 0.5 }
  local pane = { color = tint, roughness = 0.06, metallic = 0.55, name = "curtain wall" }
  local hall_glass = { color = mix(tint, "#1b2226", 0.45), roughness = 0.06, metallic = 0.4 }
  local spandrel = { color = mix(tint, "#20282c", 0.55), roughness = 0.25, metallic = 0.3 }

  local fins = parts.model({
    box(frame, -0.75, -0.71, -0.16, 0.02, 0, 3.6),
    box(frame, 0.71, 0.75, -0.16, 0.02, 0, 3.6),
    box(frame, -0.71, 0.71, -0.06, 0.02, 0.9, 0.96),
    box(frame, -0.71, 0.71, -0.08, 0.02, 0, 0.06),
  })
  local bay = extruded(
    list({ panel({ height = 0.92, material = spandrel }), panel({ material = pane, surface = "window" }) }, {
      direction = "vertical",
      width = { 0.9, 1.5, 2.2 },
    }),
    { model = fins, stretch = true }
  )
  local hall_frame = parts.model({
    box(frame, -1.5, -1.42, -0.1, 0.02, 0, 4.8),
    box(frame, 1.42, 1.5, -0.1, 0.02, 0, 4.8),
    box(frame, -1.42, 1.42, -0.05, 0.02, 2.7, 2.78),
    box(frame, -1.42, 1.42, -0.08, 0.02, 0, 0.18),
  })
  local hall = extruded(
    panel({ material = hall_glass, width = { 1.8, 3, 4.2 }, surface = "window" }),
    { model = hall_frame, stretch = true }
  )
  local entrance = parts.model({
    box(frame, -3, -2.9, 0, 0.12, 0, 4.6),
    box(frame, 2.9, 3, 0, 0.12, 0, 4.6),
    box(frame, -2.9, 2.9, 0, 0.12, 2.6, 2.75),
    box(frame, -2.9, 2.9, 0, 0.12, 4.5, 4.6),
    box(hall_glass, -2.9, 2.9, 0.05, 0.08, 0, 2.6),
    box(hall_glass, -2.9, 2.9, 0.05, 0.08, 2.75, 4.5),
    box(frame, -1.06, -1, -0.02, 0.12, 0, 2.6),
    box(frame, 1, 1.06, -0.02, 0.12, 0, 2.6),
    box(frame, -0.03, 0.03, -0.02, 0.12, 0, 2.6),
    box(parts.steel, -0.16, -0.12, -0.08, -0.04, 0.8, 1.5),
    box(parts.steel, 0.12, 0.16, -0.08, -0.04, 0.8, 1.5),
    box(frame, -2.9, 2.9, -3.2, 0, 2.85, 3.05),
  })
  local entry = extruded(
    panel({ model = entrance, stretch = true, background = false, width = { 4.5, 6, 7 }, surface = "door" }),
    { depth = -1.4, material = frame }
  )
  local edge = walls.band(0.35, 0.12, frame)
  local party = walls.surface("#8d9194")
  local slim = panel({ material = spandrel, width = { 0.3, 0.9 } })
  return {
    name = "glass_office",
    storey = 3.6,
    ground = 4.8,
    walls = {
      ground = walls.storey({
        bay = hall,
        narrow = slim,
        entry = entry,
        head = edge,
        material = spandrel,
        party = party,
      }),
      upper = walls.storey({ bay = bay, narrow = slim, material = spandrel, party = party }),
    },
    groundwork = walls.surface("#6f7476"),
    roof = {
      kind = "flat",
      border = 1,
      border_width = 0.35,
      material = walls.surface("#7f8284"),
      trim = frame,
      details = { { model = machine, on = "slope", every = 9, margin = 6, count = 2 } },
    },
  }
end

local variants = {}
for index, tint in GLASSES do
  table.insert(variants, make(tint, FRAMES[index]))
end
return variants
