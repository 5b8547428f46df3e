--!strict
-- Part of a world as large as the earth: only the view from one position is expanded, with full detail nearby. The
-- rules change with the level: continents, then mountains and plains, then single slopes.
local east = param("east", { default = 15000, min = 0, max = 33000, unit = "km", doc = "Where one stands" })
local north = param("north", { default = 21000, min = 0, max = 33000, unit = "km", doc = "Where one stands" })
local size = 512 * 2 ^ 16

-- A range of changes for each quadrant.
local function about(low: number, high: number)
  return { { low, high }, { low, high }, { low, high }, { low, high } }
end

local continents = {
  Land = { "Land", "Coast", "Land", "Land", change = about(-0.4, 0.6), decay = 0.72 },
  Coast = { "Land", "Sea", "Coast", "Coast", change = about(-0.7, 0.5), decay = 0.7 },
  Sea = { "Sea", "Sea", "Coast", "Sea", change = about(-0.7, 0.2), decay = 0.62 },
}
local regions = {
  Plain = {
    { "Plain", "Plain", "Hills", "Plain", change = about(-0.2, 0.2), decay = 0.5, weight = 2 },
    { "Hills", "Plain", "Hills", "Range", change = about(-0.4, 0.6), decay = 0.62 },
  },
  Hills = { "Hills", "Plain", "Range", "Hills", change = about(-0.6, 0.6), decay = 0.56 },
  Range = { "Range", "Range", "Hills", "Range", change = about(-1, 1), decay = 0.6 },
}
local slopes = {
  Rock = { "Rock", "Scree", "Rock", "Rock", change = about(-1, 1), decay = 0.52 },
  Scree = { "Scree", "Scree", "Rock", "Scree", change = about(-0.7, 0.7), decay = 0.48 },
}

local world = lsystem({
  object = terrain({
    size = size,
    position = { size / 2, size / 2 },
    rules = {
      { rules = continents, start = "Land", height = 300, decay = 900 },
      { from = 11, rules = regions, start = "Range", decay = 1300 },
      { from = 15, rules = slopes, start = "Rock", decay = 150 },
    },
    error = 0.4,
    water = { level = 0, clarity = 25 },
    covers = {
      { color = "#6e7747" },
      { color = "#54643a", on = { patches = 1, scale = 700 } },
      { color = "#8d8166", on = { noise = 0.5, scale = 200, height = { 500, 1100 } } },
      { color = "#857d71", on = { slope = { 20, 34 }, noise = 0.3, scale = 90 } },
      { color = "#f3f5f8", on = { height = { 1300, 1700 }, slope = { 55, 40 }, noise = 0.3, scale = 150 } },
      { color = "#b7a987", on = { height = { 8, 2 } } },
    },
  }),
  interpret = "last",
})

-- Tiles of 512 m around the viewer: the nearest 4 x 4 with 256 x 256 heights each, the outermost with 4 x 4.
local VIEW = { cell = 512, rings = { { 4, 8 }, { 8, 6 }, { 12, 4 }, { 16, 2 } } }
local Viewer = module("Viewer", "x", "y")
world:axiom(Viewer(east * 1000, north * 1000))
world:interpret("Viewer(x, y)", function(this, x, y)
  this:focus(x, y, VIEW)
end)
world:derive(0)
