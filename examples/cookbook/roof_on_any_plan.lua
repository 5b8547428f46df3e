--!strict
-- Roofs over any plan: a straight skeleton finds the ridges, also over wings, courtyards and slanted walls.
local kind =
  param("kind", { default = "hip", choices = { "hip", "gable", "mansard", "dutch_hip", "pagoda" } })

local plans = {
  {
    id = "star",
    plan = {
      { 0, 6 },
      { 6, 6 },
      { 6, 0 },
      { 13, 0 },
      { 13, 6 },
      { 20, 8 },
      { 20, 14 },
      { 13, 14 },
      { 11, 20 },
      { 4, 18 },
      { 6, 13 },
      { 0, 13 },
    },
  },
  {
    id = "court",
    plan = { { 26, 0 }, { 46, 0 }, { 46, 18 }, { 26, 18 } },
    hole = { { 32, 6 }, { 40, 6 }, { 40, 12 }, { 32, 12 } },
  },
}
-- The wall of a round tower.
local round = {}
for number = 0, 23 do
  local angle = math.rad(15 * number)
  table.insert(round, { 59 + 6.5 * math.cos(angle), 9 + 6.5 * math.sin(angle) })
end
table.insert(plans, { id = "round", plan = round })

local House = module("House", "height")
local houses = lsystem({ object = footprint })
houses:axiom(source(plans), function(feature)
  local rings = if feature.hole then { feature.plan, feature.hole } else { feature.plan }
  return footprint(rings, { color = "#e3d6bd" }), House(random(4, 7))
end)
houses:interpret("House(height)", function(this, height)
  this:walls({ height = height }):roof({
    kind = kind,
    slope = 42,
    overhang = 0.6,
    slab = 0.2,
    color = "#8d4a3b",
    trim = { color = "#f0eadc" },
  })
end)
houses:derive()
