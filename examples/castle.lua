--!strict
-- A castle on a hill, built with the package castle in examples/mods, which depends on the package masonry.
-- burgeon run examples/castle.lua -o castle.glb
local castle = require("@castle")

local corners = param("corners", { default = 7, min = 4, max = 12, step = 1, doc = "towers in the ring" })
local size = param("size", { default = 34, min = 22, max = 60, unit = "m", doc = "radius of the ring" })
local height =
  param("wall height", { default = 9, min = 6, max = 14, unit = "m", doc = "height of the walls" })
local keep_height =
  param("keep height", { default = 21, min = 12, max = 30, unit = "m", doc = "height of the keep" })

-- The ring is irregular like the hill. The gate is in the middle of the first wall, which faces south.
local ring = {}
for number = 1, corners do
  local angle = math.rad(-90 - 180 / corners + (number - 1) * 360 / corners)
  local far = size * (if number <= 2 then 1 else random(0.86, 1.1))
  table.insert(ring, vec(math.cos(angle) * far * 1.12, math.sin(angle) * far, 0))
end

local gate = (ring[1] + ring[2]) * 0.5
local half = 5.2
local along = (ring[2] - ring[1]):unit()
local wall = { gate + along * half }
for number = 2, corners do
  table.insert(wall, ring[number])
end
table.insert(wall, ring[1])
table.insert(wall, gate - along * half)
castle.curtain(wall, height)

local models: { [any]: any } = { gatehouse = castle.gatehouse(2 * half, 7.5, height + 3.4) }
for number = 1, corners do
  models[number] = castle.tower({
    storeys = if number <= 2 then 3 else math.floor(random(3, 5)),
    radius = if number <= 2 then 3.8 else random(3.4, 4.6),
    roof = number > 2 or corners < 6,
    seed = number,
  })
end
for side = -1, 1, 2 do
  models[`turret {side}`] = castle.tower({ storeys = 3, radius = 2.6, roof = true, seed = 100 + side })
end

local middle = vec(2, 5, 0)
castle.keep({
  middle + vec(-9, -6.5, 0),
  middle + vec(9, -6.5, 0),
  middle + vec(9, 6.5, 0),
  middle + vec(-9, 6.5, 0),
}, keep_height)
local stair = castle.tower({ storeys = 6, radius = 2.7, roof = true, seed = 7 })
castle.keep({
  middle + vec(-24, -3, 0),
  middle + vec(-12, -3, 0),
  middle + vec(-12, 5.5, 0),
  middle + vec(-24, 5.5, 0),
}, 8.6)

local At = module("At", "model", "place")
local all = lsystem({ object = turtle({}) })
local placed = { At(models.gatehouse, gate), At(stair, middle + vec(9, -6.5, 0)) }
for number, place in ring do
  table.insert(placed, At(models[number], place))
end
for side = -1, 1, 2 do
  table.insert(placed, At(models[`turret {side}`], gate + along * (side * half) - vec(0, 3.4, 0)))
end
all:axiom(table.unpack(placed))
all:interpret("At(model, place)", function(this, model, place)
  this:jump(place):place(model)
end)
all:derive()

-- The hill descends from the ward in ever steeper rings, and a path leads up to the gate.
local slopes = { { 1.32, 0 }, { 1.5, -1.6 }, { 1.72, -5.4 }, { 1.92, -11 } }
local Hill = module("Hill")
local hill = lsystem({ object = extruder({ smooth = true }) })
hill:axiom(Hill())
hill:interpret("Hill()", function(this)
  this:regular(96):material({ color = "#7f8a52", roughness = 1 }):jump({ 0, 0, slopes[#slopes][2] - 3 })
  this:scale(size * 1.98):taper(size * slopes[#slopes][1]):extrude(3)
  for number = #slopes - 1, 1, -1 do
    this:taper(size * slopes[number][1]):extrude(slopes[number][2] - slopes[number + 1][2])
  end
  this:material({ color = "#a89a72", roughness = 1 }):scale(size * 0.98, size * 0.86):extrude(0.08)
  this:material({ color = "#b7a680", roughness = 1 }):smooth(false)
  local from = gate + vec(0, 8, 0)
  for _, slope in slopes do
    local to = vec(gate.x, -slope[1] * size, slope[2])
    local way = to - from
    this
      :jump(from)
      :direction({ 0, 0, 1 })
      :direction(way:unit())
      :rectangle(3.6, 0.24)
      :scale(1)
      :extrude(way:length())
    from = to
  end
end)
hill:derive()

-- Trees on the slopes: crowns of two sizes on short trunks.
local Tree = module("Tree", "place", "size")
local trees: { any } = {}
for _ = 1, 46 do
  local angle, far = random(0, 360), random(1.5, 1.86)
  -- The slopes in front of the gate have no trees.
  if math.abs(angle - 270) > 24 then
    local z = -1.6 - (far - 1.5) * 24
    local place = vec(math.cos(math.rad(angle)) * far * size, math.sin(math.rad(angle)) * far * size, z - 0.6)
    table.insert(trees, Tree(place, random(0.8, 1.5)))
  end
end
local wood = lsystem({ object = extruder({ sides = 9, smooth = true }) })
wood:axiom(table.unpack(trees))
wood:interpret("Tree(place, size)", function(this, place, size)
  this:jump(place):color("#6a5238"):scale(0.22 * size):extrude(1.4 * size)
  local greens = { "#55693a", "#5f7440", "#6a7d45" }
  this:color(greens[1 + math.floor(place.x * 7) % 3])
  this:scale(0.5 * size):taper(1.5 * size):extrude(0.9 * size):taper(1.2 * size):extrude(1.3 * size)
  this:taper(0.1 * size):extrude(1.1 * size)
end)
wood:derive()
