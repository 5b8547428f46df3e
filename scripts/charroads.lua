--!strict
-- Roads from a word of an L-system: F builds a street, + and - bend it, [ and ] enclose a branch, and productions
-- rewrite X. Bends and branches have separate angles: 20 and 90 degrees give spacious roads, 20 and 20 dense ones.
local roads = require("templates/roads")

local iterations = param("iterations", { default = 7, min = 1, max = 10, step = 1 })
local bend = param("bend", { default = 20, min = 5, max = 85, unit = "deg" })
local branch = param("branch", { default = 90, min = 10, max = 170, unit = "deg" })
local split = param("split", { default = "alternate", choices = { "alternate", "symmetric", "plain" } })
local word =
  param("word", { default = "F[X]F+X|F[X]F-X|F[X]FX", doc = "What X becomes; | between words to draw from" })

local system = roads.word({
  axiom = "[X]--[X]",
  productions = { X = string.split(word, "|") },
  iterations = iterations,
  bend = bend,
  branch = branch,
  split = split,
  lengths = { 110, 90, 75, 60 },
  network = { block_color = "#66774e" },
})
system:derive(iterations)
