--!strict
-- A road over a pass: the terrain is cut and filled along a curve, and a ribbon lies on it.
local width = param("width", { default = 14, min = 4, max = 40, unit = "m", doc = "Width of the road" })

local any = { -1, 1 }
local hills = { Hill = { "Hill", "Hill", "Hill", "Hill", change = { any, any, any, any }, decay = 0.5 } }

-- The way in plan, and its heights: smooth between the two ends.
local way = curve({ { -250, -160, 0 }, { -110, 20, 0 }, { 10, -30, 0 }, { 90, 110, 0 }, { 250, 150, 0 } })
local heights = ramp({ { 0, 4 }, { 0.5, 26 }, { 1, 10 } })
local path = {}
for number = 0, 60 do
  local place = way:point(number / 60)
  table.insert(path, { place.x, place.y, heights:at(number / 60) })
end

local Road = module("Road")
local land = lsystem({
  object = terrain({
    size = 500,
    levels = 8,
    rules = hills,
    decay = 60,
    base = -75,
    covers = {
      { color = "#7f9055" },
      { color = "#9aa063", on = { patches = 0.7, scale = 70 } },
      { color = "#8a7c6a", on = { slope = { 26, 36 } } },
    },
  }),
})
land:axiom(Road())
land:interpret("Road", function(this)
  this:cut(path, width + 6, 30)
end)
land:derive(0)

-- The carriageway: a ribbon of quads, 10 cm above the cut, and a dashed line on it.
local Ribbon = module("Ribbon", "wide", "rise", "color", "dash")
local asphalt = lsystem({ object = extruder({ roughness = 1 }) })
asphalt:axiom({ Ribbon(width, 0.3, "#55565a", 1) }, { Ribbon(0.6, 0.45, "#efeadd", 2) })
asphalt:interpret("Ribbon(wide, rise, color, dash)", function(this, wide, rise, color, dash)
  local points, faces = {}, {}
  local pieces = 120
  for number = 0, pieces do
    local part = number / pieces
    local place, ahead = way:point(part), way:tangent(part)
    for _, side in { -0.5, 0.5 } do
      table.insert(
        points,
        { place.x - ahead.y * side * wide, place.y + ahead.x * side * wide, heights:at(part) + rise }
      )
    end
    if number < pieces and number % dash == 0 then
      table.insert(faces, { 2 * number + 1, 2 * number + 3, 2 * number + 4, 2 * number + 2 })
      table.insert(faces, { 2 * number + 2, 2 * number + 4, 2 * number + 3, 2 * number + 1 })
    end
  end
  this:color(color):mesh(points, faces)
end)
asphalt:derive(0)
