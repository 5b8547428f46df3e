--!strict
-- All building styles on the same plans: two rectangles and an L, in a row or detached.
-- burgeon run scripts/styles.lua -o styles.glb
local build = require("templates/build")

local only =
  param("style", { default = "all", choices = { "all", table.unpack(build.names) }, doc = "Style" })
local levels =
  param("levels", { default = 0, min = 0, max = 12, step = 1, doc = "Storeys; 0 for as many as are usual" })

local features, fronts = {}, {}
local east, north = 0, 0
for _, name in if only == "all" then build.names else { only } do
  local usual = build.usual[name]
  local w, d = usual.width, usual.depth
  local function plan(variant: number, points: any)
    local ring = {}
    for _, point in points do
      table.insert(ring, { east + point[1], north + point[2] })
    end
    table.insert(features, {
      id = `{name} {variant}`,
      geometry = { ring },
      style = build.style(name, variant),
      levels = if levels > 0 then levels else usual.levels,
    })
  end
  plan(1, { { 0, 0 }, { w, 0 }, { w, d }, { 0, d } })
  local gap = usual.gap or 0
  local second = w + gap
  plan(2, { { second, 0 }, { second + w, 0 }, { second + w, d }, { second, d } })
  -- The corner house extends back by nearly its own depth again.
  local from = 2 * second
  local to, back = from + 1.2 * math.max(w, d), 1.8 * d
  local wing = to - math.min(d, (to - from) * 0.6)
  plan(3, { { from, 0 }, { to, 0 }, { to, back }, { wing, back }, { wing, d }, { from, d } })
  table.insert(fronts, { { east - 5, north - 6 }, { east + to + 5, north - 6 } })
  east += to + 9
  if east > 150 then
    east, north = 0, north - 40
  end
end

local along = streets(fronts)
local houses = build.system()
houses:axiom(source(features), function(feature)
  return footprint(feature.geometry, { streets = along }),
    build.Building(feature.style, feature.levels, 0, "shop")
end)
houses:derive()
