--!strict
-- A church: high stone walls with lancet windows between buttresses, and a steep slate roof.
local parts = require("templates/parts")
local walls = require("templates/walls")
local box, beam, plate = parts.box, parts.beam, parts.plate

-- The outline of a pointed arch.
local function lancet(w: number, spring: number, tip: number)
  return {
    { -w, 0 },
    { w, 0 },
    { w, spring },
    { w * 0.8, lerp(spring, tip, 0.45) },
    { w * 0.45, lerp(spring, tip, 0.78) },
    { 0, tip },
    { -w * 0.45, lerp(spring, tip, 0.78) },
    { -w * 0.8, lerp(spring, tip, 0.45) },
    { -w, spring },
  }
end

local function make(color: string)
  local stone, trim = walls.surface(color, "ashlar"), walls.surface(mix(color, "#ffffff", 0.2))
  local glass = { color = "#2c3350", roughness = 0.15, metallic = 0.2, name = "church glass" }
  local function window(w: number, h: number)
    return parts.model({
      plate(trim, lancet(w + 0.18, h * 0.7, h + 0.22), -0.07, 0.02),
      plate(glass, lancet(w, h * 0.7, h), -0.09, 0.01),
      box(trim, -0.04, 0.04, -0.11, 0, 0, h * 0.96),
      box(trim, -w, w, -0.105, 0, h * 0.33, h * 0.33 + 0.05),
      box(trim, -w, w, -0.105, 0, h * 0.66, h * 0.66 + 0.05),
      box(trim, -w - 0.25, w + 0.25, -0.2, 0.02, -0.16, 0),
    })
  end
  local portal = parts.model({
    plate(trim, lancet(1.5, 2.6, 4.6), -0.25, 0.02),
    plate(stone, lancet(1.25, 2.5, 4.25), -0.28, 0),
    plate(parts.painted("#4a2f20"), lancet(1.0, 2.3, 3.9), -0.3, 0),
    beam(parts.iron, { 0, 0 }, { 0, 3.8 }, 0.03, -0.32, -0.29),
    box(trim, -1.8, 1.8, -0.7, 0, 0, 0.14),
  })
  local buttress = extruded(panel({ width = { 0.35, 0.35 } }), { depth = 0.55 })
  local function bay(model, below: number)
    local face = bordered(
      panel({ model = model, width = 2, surface = "window" }),
      { bottom = { below, "max" }, top = 0.1 }
    )
    return list({ buttress, face, buttress }, { width = { 2.6, 4, 6 } })
  end
  local door = bordered(
    panel({ model = portal, at = "bottom", width = { 3.6, 4 }, surface = "door" }),
    { left = 0.3, right = 0.3 }
  )
  local plinth = walls.band(0.6, 0.6, stone)
  local cornice = walls.cornice({ { 0.2, 0.15 }, { 0.15, 0.3 } }, trim)
  local slim = bordered(
    panel({ model = window(0.3, 2.4), surface = "window" }),
    { left = 0.3, right = 0.3, bottom = { 2, "max" } }
  )
  local slates = walls.surface("#59616b", "slates")
  local function storey(model, below: number, entry)
    return walls.storey({
      bay = bay(model, below),
      narrow = slim,
      entry = entry,
      foot = if below > 1 and not entry then plinth else nil,
      material = stone,
    })
  end
  return {
    name = "church",
    storey = 6,
    ground = 8.5,
    walls = {
      ground = storey(window(0.75, 4.6), 2.2, door),
      upper = storey(window(0.5, 3), 1, nil),
      top = walls.storey({ bay = bay(window(0.5, 3), 1), narrow = slim, head = cornice, material = stone }),
    },
    pick = function(number: number, levels: number): string
      return if number == 1 then "ground" elseif number == levels then "top" else "upper"
    end,
    groundwork = stone,
    roof = {
      kind = "gable",
      slope = 54,
      overhang = 0.35,
      slab = 0.2,
      material = slates,
      gable = stone,
      trim = trim,
    },
    tower = { kind = "hip", slope = 76, overhang = 0.4, slab = 0.3, material = slates, trim = trim },
  }
end

return { make("#cdbf9f"), make("#b9b3a4") }
