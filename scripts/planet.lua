--!strict
-- A planet of seas and continents, from orbit to the ground. Its faces divide by rules for three scales: continental
-- plates and deep sea, then lowlands and mountain belts, then meadows and crags.
local seed = param("seed", { default = 129, min = 0, max = 1000, step = 1, doc = "Which planet it is" })
local approach =
  param("approach", { default = 0, min = 0, max = 1, doc = "From the orbit (0) down to the ground (1)" })
local radius =
  param("radius", { default = 1200000, min = 100000, max = 7000000, unit = "m", doc = "Of the planet" })
local sea = param("sea", { default = 0, min = -3000, max = 3000, unit = "m", doc = "Level of the seas" })
local cold =
  param("cold", { default = 0, min = -20, max = 40, unit = "deg", doc = "How far the ice reaches" })

-- Each rule has a symbol and a height change for each quadrant. The changes are random, and the decay reduces them on
-- each level.
local ANY, SOME, FEW = { -1, 1 }, { -0.6, 0.6 }, { -0.35, 0.35 }
local UP, DOWN = { 0.1, 1.1 }, { -1.1, -0.1 }

local plates = {
  Plate = {
    { "Plate", "Deep", "Plate", "Plate", change = { ANY, DOWN, UP, ANY }, decay = 0.62 },
    { "Deep", "Plate", "Plate", "Deep", change = { DOWN, UP, UP, DOWN }, decay = 0.62 },
    { "Plate", "Plate", "Deep", "Plate", change = { UP, ANY, DOWN, ANY }, decay = 0.62 },
  },
  Deep = {
    { "Deep", "Plate", "Deep", "Deep", change = { DOWN, UP, ANY, ANY }, decay = 0.62 },
    { "Deep", "Deep", "Plate", "Deep", change = { ANY, ANY, UP, DOWN }, decay = 0.62 },
  },
}

local belts = {
  Low = {
    { "Low", "Low", "Low", "Low", change = { FEW, FEW, FEW, FEW }, decay = 0.55, weight = 5 },
    { "Low", "High", "High", "Low", change = { SOME, UP, UP, SOME }, decay = 0.64 },
    { "High", "Low", "Low", "High", change = { UP, SOME, SOME, UP }, decay = 0.64 },
  },
  High = {
    { "High", "High", "High", "High", change = { ANY, ANY, ANY, ANY }, decay = 0.63, weight = 6 },
    { "High", "Low", "High", "Low", change = { UP, SOME, UP, SOME }, decay = 0.6 },
  },
}

local soil = {
  Meadow = {
    { "Meadow", "Meadow", "Meadow", "Meadow", change = { FEW, FEW, FEW, FEW }, decay = 0.46, weight = 4 },
    { "Meadow", "Crag", "Crag", "Meadow", change = { FEW, UP, UP, FEW }, decay = 0.5 },
  },
  Crag = {
    { "Crag", "Crag", "Meadow", "Crag", change = { ANY, ANY, FEW, ANY }, decay = 0.5 },
    { "Meadow", "Crag", "Crag", "Meadow", change = { FEW, ANY, ANY, FEW }, decay = 0.48 },
  },
}

-- The eye descends to a coast: each step divides its height by the same number.
local height = 3 * radius * (2 / (3 * radius)) ^ approach

local land = lsystem({
  object = planet({
    radius = radius,
    seed = seed,
    rules = {
      { from = 0, rules = plates, start = "Plate", decay = 2600, height = -350 },
      { from = 5, rules = belts, start = "Low", decay = 1100 },
      { from = 12, rules = soil, start = "Meadow", decay = 30 },
    },
    levels = 22,
    closeness = 9 - 6.5 * math.min(1, approach * 3),
    error = 0.02 + 0.06 * math.min(1, approach * 3),
    axis = { -0.6, -0.4, 0.65 },
    horizon = approach > 0,
    water = { level = sea, color = "#0a2a4d", shallow = "#2f7f94", clarity = 350 },
    ice = { color = "#eef3f6", on = { latitude = { 74 - cold, 79 - cold }, noise = 0.8, scale = radius / 9 } },
    covers = {
      { color = "#5d7a3c" },
      { color = "#2f5a2b", on = { latitude = { 22, 6 }, noise = 0.7, scale = radius / 12 } },
      { color = "#c9a66b", on = { latitude = { 12, 18 }, noise = 0.6, scale = radius / 10 } },
      { color = "#6f8246", on = { latitude = { 30, 38 }, noise = 0.6, scale = radius / 10 } },
      { color = "#3c5a38", on = { latitude = { 45, 54 }, noise = 0.6, scale = radius / 14 } },
      { color = "#8a8566", on = { latitude = { 60 - cold, 67 - cold }, noise = 0.5, scale = radius / 14 } },
      -- Woods and meadows, which appear as the eye comes nearer.
      { color = "#34502a", on = { noise = 1, scale = 60000, height = { 1100, 600 } }, amount = 0.45 },
      { color = "#7d8450", on = { patches = 1, scale = 4000 }, amount = 0.35 },
      { color = "#3b4a26", on = { patches = 1, scale = 250 }, amount = 0.4 },
      { color = "#7d6c55", on = { height = { 1000, 1900 }, noise = 0.4, scale = radius / 30 } },
      { color = "#6b6459", on = { slope = { 20, 32 }, noise = 0.3, scale = 800 } },
      { color = "#d8c79a", on = { height = { sea + 60, sea + 5 }, noise = 0.3, scale = 5000 }, amount = 0.6 },
      { color = "#f4f6f8", on = { height = { 1900, 2600 }, noise = 0.4, scale = radius / 30 } },
      { color = "#f4f6f8", on = { latitude = { 68 - cold, 75 - cold }, noise = 0.6, scale = radius / 12 } },
    },
  }),
})

local Eye = module("Eye")
land:axiom(Eye())
land:interpret("Eye", function(this)
  if approach > 0 then
    local ground = this:surface({ 0, 0, 1 })
    this:focus(0, 0, ground.z + height)
  end
end)

land:derive(0)
