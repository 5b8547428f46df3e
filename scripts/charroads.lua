--!strict
-- Roads that are written as a word: F builds a street, + and - bend it, [ and ] hold a branch, and X is rewritten. Bends
-- and branches have angles of their own: with 20 and 90 degrees roads keep apart, with 20 and 20 they are dense.
local roads = require("templates/roads")

local iterations = param("iterations", { default = 7, min = 1, max = 10, step = 1 })
local bend = param("bend", { default = 20, min = 5, max = 85, unit = "deg" })
local branch = param("branch", { default = 90, min = 10, max = 170, unit = "deg" })
local split = param("split", { default = "alternate", choices = { "alternate", "symmetric", "plain" } })
local word =
  param("word", { default = "F[X]F+X|F[X]F-X|F[X]FX", text = "What X becomes; | between words to draw from" })

local system = roads.word({
  axiom = "[X]--[X]",
  productions = { X = string.split(word, "|") },
  iterations = iterations,
  bend = bend,
  branch = branch,
  split = split,
  lengths = { 110, 90, 75, 60 },
  network = { ground = "#66774e" },
})
system:derive(iterations)
