--!strict
-- A valley with a lake, a river, rocks and a forest of three kinds of trees.
local relief =
  param("relief", { default = 150, min = 20, max = 300, unit = "m", doc = "Height of the mountains" })
local lake = param("lake", { default = -18, min = -80, max = 60, unit = "m", doc = "Level of the lake" })
local density = param("density", { default = 110, min = 0, max = 400, doc = "Trees per hectare" })

-- Three trees, each built once: a spruce, a round tree and a bush.
local Trunk, Cone, Ball =
  module("Trunk", "height"), module("Cone", "radius"), module("Ball", "radius", "turn")
local function tree(color: string, ...: Module): Derived
  local system = lsystem({ object = turtle({ sides = 6, color = "#5e4a35" }) })
  system:axiom(...)
  system:interpret("Trunk(height)", function(this, height)
    this:width(0.4):forward(height)
  end)
  system:interpret("Cone(radius)", function(this, radius)
    this:color(color):width(2 * radius):advance(-0.01):width(2 * radius)
    this:forward(0.01):width(0.3 * radius):forward(radius * 1.5):advance(-radius * 0.5)
  end)
  system:interpret("Ball(radius, turn)", function(this, radius, turn)
    local angle = math.rad(turn)
    local place = vec(radius * 0.7 * math.cos(angle), radius * 0.7 * math.sin(angle), 0)
    this:color(color):jump(this:position() + place):sphere(radius)
  end)
  return system:derive(0)
end
local spruce = tree("#3c5b3c", Trunk(1.6), Cone(2.3), Cone(1.9), Cone(1.4), Cone(0.9))
local beech = tree(
  "#6b8a3f",
  Trunk(3.4),
  { Ball(1.9, 0) },
  { Ball(1.8, 120) },
  { Ball(1.9, 240) },
  G(1.6),
  Ball(1.7, 60)
)
local bush = tree("#7f9248", { Ball(0.8, 0) }, { Ball(0.7, 150) }, Ball(0.6, 260))

-- Each cell becomes four: the north rises to mountains, the middle is a valley.
local any = { -1, 1 }
local rules = {
  Land = { "Mountain", "Mountain", "Hill", "Shore", change = { 0.55, 0.5, 0.1, -0.34 }, decay = 0.6 },
  Mountain = {
    "Mountain",
    "Mountain",
    "Hill",
    "Hill",
    change = { any, any, any, { -0.6, 0.6 } },
    decay = 0.55,
  },
  Hill = { "Hill", "Hill", "Hill", "Hill", change = { any, any, any, any }, decay = 0.46 },
  Shore = { "Hill", "Hill", "Hill", "Shore", change = { 0.1, 0.05, 0.05, -0.2 }, decay = 0.3 },
}

local Spring, River = module("Spring"), module("River", "place")
local land = lsystem({
  object = terrain({
    size = 1300,
    levels = 9,
    rules = rules,
    start = "Land",
    decay = relief,
    base = -0.85 * relief,
    sides = "#6b5c4d",
    water = { level = lake, color = "#1f4a58", shallow = "#6d9c94", clarity = 9 },
    covers = {
      { color = "#7b8b50" },
      { color = "#98a060", on = { patches = 0.7, scale = 150 } },
      { color = "#c8b78a", on = { height = { lake + 7, lake + 2 } } },
      { color = "#84796b", on = { slope = { 26, 36 }, noise = 0.4, scale = 50 } },
      { color = "#f1f3f5", on = { height = { 128, 150 }, slope = { 46, 34 }, noise = 0.4, scale = 60 } },
    },
    plants = {
      {
        models = { spruce },
        density = density,
        size = { 0.9, 1.9 },
        sink = 0.3,
        on = { height = { lake + 25, lake + 60 }, slope = { 34, 24 }, patches = 0.55, scale = 170 },
      },
      {
        models = { beech },
        density = density * 0.6,
        size = { 0.9, 1.5 },
        sink = 0.3,
        on = { height = { lake + 45, lake + 20 }, slope = { 22, 14 }, patches = 0.6, scale = 120 },
      },
      {
        models = { bush },
        density = density * 0.5,
        on = { height = { lake + 3, lake + 8 }, slope = { 30, 20 }, patches = 0.8, scale = 60 },
      },
    },
  }),
})

-- A river begins in the north-west, at the first of some random places from which it cuts no deep gorge.
land:axiom(Spring())
land:rule("Spring", function(this)
  for _ = 1, 60 do
    local place = vec(random(-450, -50), random(100, 450), 0)
    local depth = this:river_cut(place, 9)
    if depth and depth < 4 then
      return River(place)
    end
  end
  return nil
end)
land:interpret("River(place)", function(this, place)
  this:river(place, 9)
end)
land:derive(1)
