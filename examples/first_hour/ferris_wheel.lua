--!strict
-- A Ferris wheel: a rule halves the sectors between the spokes, and each spoke carries a cabin that hangs upright.
-- A film of its turn: burgeon run ferris_wheel.lua --frames 0:0.95:0.05 -o wheel.gif
local radius = param("radius", { default = 20, min = 8, max = 60, unit = "m", doc = "Radius of the wheel" })
local doublings =
  param("doublings", { default = 3, min = 1, max = 4, step = 1, doc = "Spokes: 3 x 2 ^ doublings" })
local time = param("time", { default = 0, min = 0, max = 1, doc = "Part of a turn" })
local steel = param("color", { default = "#e9e7e1", doc = "Colour of the steel" })

local HUB = radius + 4
local function at(turn: number, reach: number, y: number): Vector
  return vec(reach * math.sin(math.rad(turn)), y, HUB + reach * math.cos(math.rad(turn)))
end

-- A cabin hangs below its origin.
local Cabin = module("Cabin", "color")
local function cabin(color: Color): Model
  local system = lsystem({ object = extruder({ sides = 24, roughness = 0.35 }) })
  system:axiom(Cabin(color))
  system:interpret("Cabin(color)", function(this, color)
    this:color(color):jump({ 0, 0, -2.6 })
    this:scale(0.6):taper(0.95):extrude(0.3):extrude(0.55)
    this:color("#2d3a44"):scale(0.9):extrude(0.75)
    this:color(color):scale(1):extrude(0.12):taper(0.25):extrude(0.45)
    this:color(steel):scale(0.06):extrude(0.5)
    for number = 1, 8 do
      local turn = math.rad(45 * number)
      this:color(color):jump(vec(0.9 * math.cos(turn), 0.9 * math.sin(turn), -1.8)):scale(0.06):extrude(0.8)
    end
  end)
  return system:derive(0)
end
local models = {}
for number, color in { "#c8452f", "#e0a32e", "#3f8f6b", "#2f6fa3", "#7a4a92", "#d9783a" } do
  models[number] = cabin(color)
end

local Sector, Stand = module("Sector", "turn", "width"), module("Stand")
local wheel = lsystem({ object = turtle({ sides = 10, color = steel, roughness = 0.4 }) })
wheel:axiom({ Stand() }, Sector(0, 120), Sector(120, 120), Sector(240, 120))
wheel:rule("Sector(turn, width)", function(this, turn: number, width: number)
  return Sector(turn, width / 2), Sector(turn + width / 2, width / 2)
end)
wheel:interpret("Sector(turn, width)", function(this, turn: number, width: number)
  local function bar(from: Vector, to: Vector, thickness: number)
    this:jump(from):face(to - from):width(thickness):forward(from:distance(to))
  end
  local a, b, middle = turn + 360 * time, turn + width + 360 * time, turn + width / 2 + 360 * time
  for _, side in { -1, 1 } do
    bar(at(a, 0.6, 1.6 * side), at(a, radius, 1.1 * side), 0.16)
    bar(at(a, radius, 1.1 * side), at(b, radius, 1.1 * side), 0.3)
    bar(at(a, radius * 0.82, 1.2 * side), at(b, radius * 0.82, 1.2 * side), 0.16)
    bar(at(a, radius * 0.82, 1.2 * side), at(middle, radius, 1.1 * side), 0.1)
    bar(at(middle, radius, 1.1 * side), at(b, radius * 0.82, 1.2 * side), 0.1)
  end
  bar(at(a, radius, -1.3), at(a, radius, 1.3), 0.22)
  this
    :jump(at(a, radius, 0))
    :face({ 0, 0, 1 })
    :place(models[math.round(turn / width) % #models + 1], radius / 14)
end)
wheel:interpret("Stand", function(this)
  this:color("#8f8a82"):shape(cuboid(radius * 1.5, 14, 0.5):translate(vec(-radius * 0.75, -7, 0)))
  this:color("#b9b3a6"):shape(cuboid(7, 3.6, 0.6):translate(vec(-3.5, -1.8, 0.5)))
  this:color("#c8452f")
  this:width(1.6):jump({ 0, -3.4, HUB }):face({ 0, 1, 0 }):forward(6.8)
  for _, side in { -1, 1 } do
    for _, foot in { -1, 1 } do
      local from, to = vec(foot * radius * 0.6, 6 * side, 0.5), vec(0, 3 * side, HUB)
      this:jump(from):face(to - from):width(0.9):forward(from:distance(to))
    end
    this:jump(vec(-radius * 0.35, 4.75 * side, HUB * 0.42)):face({ 1, 0, 0 }):width(0.4):forward(radius * 0.7)
  end
end)
wheel:derive(doublings)
