--!strict
-- Parts of facades: walls and roofs by style, and windows, doors and balconies along a wall.
local details = {}

details.storey = param("storey", { default = 3, min = 2.4, max = 5, unit = "m", doc = "How high a floor is" })

type Style = {
  wall: string,
  roof: string,
  trim: string,
  shutter: string,
  bay: number,
  balcony: boolean,
  slope: number,
}
local STYLES: { Style } = {
  {
    wall = "#cdb894",
    roof = "#8b4a36",
    trim = "#e6dcc6",
    shutter = "#5d6f5f",
    bay = 3.0,
    balcony = false,
    slope = 0.75,
  },
  {
    wall = "#d8a987",
    roof = "#9c5540",
    trim = "#efe3d2",
    shutter = "#58677f",
    bay = 2.7,
    balcony = false,
    slope = 0.8,
  },
  {
    wall = "#d9d0bd",
    roof = "#5d666e",
    trim = "#efeadf",
    shutter = "#8d949a",
    bay = 2.6,
    balcony = true,
    slope = 0.45,
  },
  {
    wall = "#c9ccca",
    roof = "#6d6f70",
    trim = "#e4e5e2",
    shutter = "#4c5358",
    bay = 3.4,
    balcony = true,
    slope = 0.3,
  },
}
local GLASS = { color = "#49565f", roughness = 0.15, metallic = 0.2 }
local RAIL = "#2e3033"

local function style_of(style: number): Style
  return STYLES[style] or STYLES[1]
end

-- A hip roof above the eaves: a plane above each wall that rises by `slope` per metre inwards.
function details.roof(this: any, geom: any, eaves: number, slope: number)
  for _, face in geom:skeleton_faces() do
    local corners, order = {}, {}
    for index, at in face.rings[1] do
      corners[index], order[index] = { at[1], at[2], eaves + at[3] * slope }, index
    end
    this:jump({ 0, 0, 0 }):mesh(corners, { order })
  end
end

-- A wall around all storeys, a cornice and a roof.
function details.volume(this: any, geom: any, floors: number, style: number)
  local look, height = style_of(style), floors * details.storey
  this:color(look.wall):polygon(geom):jump({ 0, 0, 0 }):extrude(height)
  this
    :color(look.trim)
    :polygon(geom:buffer(0.3, { join = "mitre" }))
    :jump({ 0, 0, height - 0.25 })
    :extrude(0.35)
  details.roof(this:color(look.roof), geom, height + 0.1, look.slope)
end

-- Windows on every storey of a wall, as many as fit; doors and shop windows on the ground floor.
function details.facade(this: any, line: any, floors: number, style: number)
  local look, length = style_of(style), line:length()
  local count = math.floor((length - 0.8) / look.bay)
  if count < 1 then
    return
  end
  local from, to = line:start_point():place(), line:end_point():place()
  local along = (to - from):unit()
  local out = vec(along.y, -along.x, 0)
  -- A plate on the wall, `width` wide, from `low` to `high`, that projects from `near` to `far`.
  local function plate(middle: any, width: number, low: number, high: number, near: number, far: number)
    local a, b = middle - along * (width / 2), middle + along * (width / 2)
    this:polygon({ a + out * far, b + out * far, b + out * near, a + out * near })
    this:jump({ 0, 0, low }):extrude(high - low)
  end
  for floor = 0, floors - 1 do
    local base = floor * details.storey
    for bay = 1, count do
      local middle = from:lerp(to, (bay - 0.5) / count)
      local width = if floor == 0 and style ~= 4 then look.bay * 0.62 else look.bay * 0.36
      local low, high = base + (if floor == 0 then 0.5 else 0.85), base + details.storey - 0.45
      local is_door = floor == 0 and bay == (count + 1) // 2
      if is_door then
        low, width = base + 0.1, 1.3
      end
      this:color(look.trim)
      plate(middle, width + 0.3, low - 0.12, high + 0.15, -0.02, 0.06)
      if is_door then
        this:color(look.shutter)
        plate(middle, width, low, high, 0.03, 0.09)
      else
        this:material(GLASS)
        plate(middle, width, low, high, 0.03, 0.08)
        this:color(look.trim)
        plate(middle, 0.07, low, high, 0.05, 0.1)
        if floor > 0 then
          this:color(look.shutter)
          for side = -1, 1, 2 do
            plate(middle + along * (side * (width / 2 + 0.26)), 0.42, low, high, 0.02, 0.08)
          end
        end
      end
      if look.balcony and floor > 0 and floor < floors - 1 and (bay + floor) % 2 == 0 then
        this:color(look.trim)
        plate(middle, width + 1, low - 0.3, low - 0.14, 0, 0.75)
        this:color(RAIL)
        plate(middle, width + 1, low + 0.72, low + 0.78, 0.68, 0.74)
        for bar = 0, 8 do
          plate(middle + along * ((bar / 8 - 0.5) * (width + 0.96)), 0.03, low - 0.14, low + 0.74, 0.69, 0.73)
        end
      end
    end
    this:color(look.trim)
    plate(from:lerp(to, 0.5), length, base + details.storey - 0.18, base + details.storey - 0.06, -0.02, 0.07)
  end
end

return details
