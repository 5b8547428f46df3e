--!strict
-- A model from a book: a system of strings, drawn as printed.
local order = param("order", { default = 5, min = 1, max = 7, step = 1, doc = "Steps of the derivation" })

local plant = abop({
  axiom = "X",
  X = "F-[[X]+X]+F[+FX]-X",
  F = "FF",
  object = turtle({ angle = 22.5, step = 0.05, width = 0.05, color = "#5f8042" }),
})

plant:derive(order)
