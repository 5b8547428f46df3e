--!strict
-- A bookcase: splits divide it into shelves, the shelves into rows, and the rows into books with titles.
local width = param("width", { default = 1.6, min = 0.5, max = 4, unit = "m", doc = "Width of the bookcase" })
local height =
  param("height", { default = 2.1, min = 0.6, max = 3, unit = "m", doc = "Height of the bookcase" })
local shelves = param("shelves", { default = 5, min = 1, max = 9, step = 1, doc = "Number of shelves" })
local wood = param("wood", { default = "#8a5a34", doc = "Colour of the wood" })

local BOARD, DEPTH = 0.025, 0.3
local dark = { "#7d2a2a", "#2f4a6b", "#3d5b41", "#5b3a58", "#2b2b30", "#9a4c33", "#2f5f66" }
local pale = { "#d9cfb8", "#c9ad74", "#b9c4bd" }
local titles = { "ILIAD", "EMMA", "FAUST", "BOTANY", "ATLAS", "POEMS", "TALES", "CELLS", "STARS", "OPERA" }

local Case, Shelf, Row = module("Case", "shape"), module("Shelf", "shape"), module("Row", "shape")
local Book, Stack, Vase = module("Book", "shape"), module("Stack", "shape"), module("Vase", "shape")
local Turned = module("Turned", "shape")
local case = lsystem({ object = extruder({ color = wood, sides = 32 }) })
case:axiom(Case(cuboid(width, DEPTH, height)))

case:rule("Case(s)", function(this, s: Shape)
  local parts: { any } = { { BOARD, Draw } }
  for _ = 1, shelves do
    table.insert(parts, { "~1", Shelf })
    table.insert(parts, { BOARD, Draw })
  end
  local back = cuboid(width, 0.01, height):translate(vec(0, DEPTH, 0))
  local side = cuboid(BOARD, DEPTH, height)
  local inner = s:resize(vec(width - 2 * BOARD, DEPTH, height)):shift(vec(BOARD, 0, 0))
  return Draw(back), Draw(side), Draw(side:translate(vec(width - BOARD, 0, 0))), split(inner, "z", parts)
end)

-- Between two rows of books there is a stack of books or a vase.
case:rule("Shelf(s)", function(this, s: Shape)
  local middle, share = choose({ Stack, Vase }), `{math.round(random(20, 60))}%`
  return split(s, "x", { { share, Row }, { 0.26, middle }, { "~1", Row } })
end)
case:rule("Row(s)", function(this, s: Shape)
  local parts: { any } = {}
  local left = s:size().x - 0.01
  while left > 0.07 do
    local thickness = random(0.018, 0.055)
    table.insert(parts, { thickness, Book })
    left -= thickness
  end
  table.insert(parts, { "~1", false })
  return split(s, "x", parts)
end)
case:rule("Stack(s)", function(this, s: Shape)
  local books: { any } = {}
  local z = 0
  for _ = 1, math.round(random(2, 5)) do
    local x, y, thickness = random(0.2, 0.23), random(0.15, 0.19), random(0.025, 0.05)
    local book = cuboid(x, y, thickness):rotate(random(-8, 8))
    table.insert(books, Draw(book:translate(s:position() + vec(0.02, 0.05, z)), choose(dark)))
    z += thickness
  end
  return sequence(books)
end)

-- In a branch, so that what follows keeps its place and its colour.
case:rule("Vase(s)", function(this, s: Shape)
  return { Turned(s) }
end)

case:interpret("Book(s)", function(this, s: Shape)
  local x, y, z = s:size().x - 0.002, random(0.17, 0.23), s:size().z * random(0.72, 0.92)
  local is_dark = random() < 0.8
  local color, ink = choose(if is_dark then dark else pale), if is_dark then "#d8b865" else "#4a3524"
  local corner = s:position() + vec(0, random(0.02, 0.04), 0)
  this:shape(cuboid(x, y, z):translate(corner), color)
  -- Between the covers, the pages show at the top.
  this:shape(cuboid(x - 0.006, y - 0.008, z):translate(corner + vec(0.003, 0.004, 0.001)), "#efe6d0")
  for _, part in { 0.12, 0.16, 0.84 } do
    this:shape(cuboid(x, 0.001, 0.004):translate(corner + vec(0, -0.001, part * z)), ink)
  end
  if x > 0.033 then
    local title = text(choose(titles), { size = 0.36 * x }):extrude(0.001)
    title = title:rotate(90, vec(1, 0, 0)):rotate(-90, vec(0, 1, 0))
    this:shape(title:translate(corner + vec(x / 2, -0.001, z / 2) - title:center()), ink)
  end
end)
local profile =
  ramp({ { 0, 0.05 }, { 0.1, 0.055 }, { 0.45, 0.095 }, { 0.75, 0.045 }, { 0.9, 0.035 }, { 1, 0.06 } })
case:interpret("Turned(s)", function(this, s: Shape)
  local piece = 0.75 * s:size().z / 32
  this
    :jump(s:position() + vec(s:size().x / 2, DEPTH / 2, 0))
    :color(choose({ "#3f7f86", "#c9793f", "#e6dcc4" }))
  for number = 1, 32 do
    this:scale(profile:at((number - 1) / 32)):taper(profile:at(number / 32)):extrude(piece)
  end
end)
case:derive()
camera({
  name = "room",
  from = { 1.6 * width, -1.8 * height, 0.85 * height },
  to = { width / 2, 0, 0.47 * height },
  fov = 34,
})
