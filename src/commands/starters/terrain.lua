--!strict
-- Hills with a lake, rocks and trees. Change a number, save, and watch the live view.
local water = param("water", { default = -14, min = -80, max = 60, unit = "m", doc = "Level of the lake" })
local relief =
  param("relief", { default = 110, min = 10, max = 300, unit = "m", doc = "Height of the hills" })
local density = param("density", { default = 70, min = 0, max = 300, doc = "Trees per hectare" })

-- A tree, built once and placed many times.
local Stem, Crown = module("Stem"), module("Crown", "radius")
local conifer = lsystem({ object = extruder({ sides = 7, color = "#5b4632" }) })
conifer:axiom(Stem(), Crown(2.4), Crown(1.9), Crown(1.3))
conifer:interpret("Stem", function(this)
  this:scale(0.35):extrude(2)
end)
conifer:interpret("Crown(radius)", function(this, radius)
  this:color("#3f5f38"):scale(radius):taper(radius * 0.2):extrude(3):advance(-0.9)
end)
local tree = conifer:derive(0)

-- Each cell becomes four cells: north-west, north-east, south-west and south-east. Each is higher or lower than its
-- cell by a random part of `relief`, which decays from level to level.
local any = { -1, 1 }
local rules = {
  Land = { "Hill", "Hill", "Hill", "Shore", change = { 0.5, 0.4, 0.2, -0.3 }, decay = 0.6 },
  Hill = { "Hill", "Hill", "Hill", "Hill", change = { any, any, any, any }, decay = 0.47 },
  Shore = { "Hill", "Hill", "Hill", "Shore", change = { 0.1, 0.1, 0.1, -0.2 }, decay = 0.35 },
}

local land = lsystem({
  object = terrain({
    size = 1000,
    levels = 8,
    rules = rules,
    start = "Land",
    decay = relief,
    base = -relief,
    water = { level = water, color = "#22505e", shallow = "#6d9c94" },
    covers = {
      { color = "#7d8b52" },
      { color = "#98a060", on = { patches = 0.7, scale = 150 } },
      { color = "#c9bb8f", on = { height = { water + 8, water + 2 } } },
      { color = "#84796b", on = { slope = { 24, 34 }, noise = 0.4, scale = 60 } },
    },
    plants = {
      {
        models = { tree },
        density = density,
        size = { 0.8, 1.8 },
        sink = 0.4,
        on = { height = { water + 4, water + 14 }, slope = { 28, 18 }, patches = 0.6, scale = 140 },
      },
    },
  }),
})

land:derive()
