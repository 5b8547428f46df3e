--!strict
-- A bookcase whose parameters stand in two groups: the case, and the books.
local width = param("width", { default = 1.2, min = 0.5, max = 3, unit = "m", group = "Case" })
local shelves = param("shelves", { default = 4, min = 1, max = 8, step = 1, group = "Case" })
local wood = param("wood", { default = "#b98d5c", group = "Case", doc = "Colour of the boards" })
local fill =
  param("fill", { default = 0.8, min = 0, max = 1, group = "Books", doc = "Filled part of a shelf" })
local tallest = param("tallest", { default = 0.27, min = 0.15, max = 0.3, unit = "m", group = "Books" })
local palette = param("palette", { default = "old", choices = { "old", "bright" }, group = "Books" })

local RISE, DEPTH, BOARD = 0.34, 0.28, 0.02
local COLORS = {
  old = { "#6b3a2e", "#3f5446", "#2f4058", "#8a6d3b", "#503a4b" },
  bright = { "#e4572e", "#17bebb", "#ffc914", "#2e7dd1", "#76b041" },
}

local Case, Row = module("Case"), module("Row", "x", "level")
local Plank = module("Plank", "x", "z", "width", "height")
local Book = module("Book", "x", "level", "thickness", "height", "color")

local case = lsystem({ object = extruder({ smooth = false }) })
case:axiom(Case())
case:rule("Case", function()
  local height = shelves * RISE + BOARD
  local modules: { any } = { Plank(-width / 2, 0, BOARD, height), Plank(width / 2, 0, BOARD, height) }
  for level = 0, shelves do
    table.insert(modules, Plank(0, level * RISE, width, BOARD))
  end
  for level = 0, shelves - 1 do
    table.insert(modules, Row(BOARD - width / 2, level))
  end
  return sequence(modules)
end)
-- Books follow each other until the shelf is as full as wanted.
case:rule("Row(x, level)", function(this, x: number, level: number)
  local thickness = random(0.018, 0.05)
  if x + thickness > BOARD - width / 2 + fill * (width - 2 * BOARD) then
    return nil
  end
  local height = tallest * random(0.72, 1)
  local book = Book(x + thickness / 2, level, thickness, height, choose(COLORS[palette]))
  return book, Row(x + thickness, level)
end)

case:interpret("Plank(x, z, width, height)", function(this, x, z, width, height)
  this:jump({ x, 0, z }):color(wood):rectangle(width, DEPTH):extrude(height)
end)
case:interpret("Book(x, level, thickness, height, color)", function(this, x, level, thickness, height, color)
  this:jump({ x, -0.02, level * RISE + BOARD }):color(color):rectangle(thickness * 0.94, 0.19):extrude(height)
end)
case:derive()
