--!strict
-- A question to data in SQL: which tower is nearest to each house? Lines show the answer.
local houses, towers = {}, {}
for number = 1, 60 do
  table.insert(houses, { id = `house {number}`, geometry = point(random(-50, 50), random(-35, 35)) })
end
for number, color in { "#c8553d", "#2f6f8f", "#6a994e", "#d9a441" } do
  table.insert(
    towers,
    { id = `tower {number}`, geometry = point(random(-40, 40), random(-28, 28)), color = color }
  )
end
source(houses, { table = "houses" })
source(towers, { table = "towers" })

local rows = query([[
  SELECT houses.geom AS house, towers.geom AS tower, towers.color
  FROM houses JOIN towers
  WHERE towers.id = (
    SELECT other.id FROM towers AS other ORDER BY ST_Distance(other.geom, houses.geom) LIMIT 1
  )
]])

local House, Tower = module("House", "from", "to", "color"), module("Tower", "place", "color")
local map = lsystem({ object = extruder({ smooth = false }) })
local modules: { any } = {}
for _, row in rows do
  table.insert(modules, { House(row.house:place(), row.tower:place(), row.color) })
end
for _, tower in towers do
  table.insert(modules, { Tower(tower.geometry:place(), tower.color) })
end
map:axiom(sequence(modules))
map:interpret("House(from, to, color)", function(this, from, to, color)
  this:jump(from):color(mix(color, "#ffffff", 0.35)):rectangle(2.2, 2.2):extrude(1.8):taper(0.1, 1):extrude(1)
  this
    :regular(8)
    :scale(0.14)
    :jump(from + vec(0, 0, 0.2))
    :direction(to - from)
    :color(color)
    :extrude(to:distance(from))
end)
map:interpret("Tower(place, color)", function(this, place, color)
  this
    :jump(place)
    :color(color)
    :regular(8)
    :scale(2.2)
    :taper(1.7)
    :extrude(11)
    :scale(2.2)
    :extrude(1.2)
    :taper(0.1)
    :extrude(3)
end)
map:derive()
