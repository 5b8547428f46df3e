--!strict
-- The Hilbert curve through all cells of a cube, drawn as a pipe with round bends. The curve through a cube consists
-- of eight curves through its octants, each rotated so that it ends next to the start of the next one.
local level =
  param("level", { default = 3, min = 1, max = 4, step = 1, doc = "How often the cube is divided" })
local width =
  param("width", { default = 0.5, min = 0.05, max = 0.8, unit = "m", doc = "Diameter; cells measure 1 m" })
local round = param("round", { default = 0.8, min = 0, max = 0.95, doc = "How much of the way is bends" })
local pieces = param("pieces", { default = 6, min = 1, max = 16, step = 1, doc = "Pieces of a bend" })

-- A cube with its first cell at p, along the axes a, b and c; the curve ends in the direction a.
local Cube = module("Cube", "p", "a", "b", "c", "n", "index")
local Cell = module("Cell", "p", "index")
local Bend = module("Bend", "from", "through", "to", "index")

local COLORS = 48
local palette = {}
for k = 0, COLORS - 1 do
  local t = k / (COLORS - 1)
  table.insert(palette, hsv(205 + 195 * t, lerp(0.72, 0.62, t), lerp(0.62, 0.98, t)))
end

local curve = lsystem({
  object = turtle({ sides = 16, palette = palette, roughness = 0.35, position = { 0, 0, width / 2 } }),
  interpret = "last",
})

curve:axiom(Cube(vec(0, 0, 0), vec(1, 0, 0), vec(0, 1, 0), vec(0, 0, 1), level, 0))

curve:rule("Cube(p, a, b, c, n, i)", function(this, p, a, b, c, n: number, i)
  if n == 0 then
    return Cell(p, i)
  end
  local half, cells = 2 ^ (n - 1), 8 ^ (n - 1)
  local far = 2 * half - 1 -- the last cell along a side
  return Cube(p, c, a, b, n - 1, i),
    Cube(p + c * half, b, c, a, n - 1, i + cells),
    Cube(p + (b + c) * half, b, c, a, n - 1, i + cells * 2),
    Cube(p + b * far + c * (half - 1), a, -b, -c, n - 1, i + cells * 3),
    Cube(p + a * half + b * far + c * (half - 1), a, -b, -c, n - 1, i + cells * 4),
    Cube(p + a * far + b * far + c * half, -b, c, -a, n - 1, i + cells * 5),
    Cube(p + a * far + b * (half - 1) + c * half, -b, c, -a, n - 1, i + cells * 6),
    Cube(p + a * far + c * (half - 1), -c, -a, b, n - 1, i + cells * 7)
end)

-- When only cells remain, each cell reads from its neighbours where the pipe enters and leaves.
curve:rule("Cell(p, h) < Cell(q, i) > Cell(r, j)", function(this, p, h, q, i, r)
  return Bend((p + q) / 2, q, (q + r) / 2, i)
end)
curve:rule("Cell(q, i) > Cell(r, j)", function(this, q, i, r)
  return Bend(q, (q * 3 + r) / 4, (q + r) / 2, i)
end)
curve:rule("Cell(p, h) < Cell(q, i)", function(this, p, h, q, i)
  return Bend((p + q) / 2, (p + q * 3) / 4, q, i)
end)

-- A quarter circle around the corner with straight ends; a straight pipe if the three positions are in line.
curve:interpret("Bend(p, q, r, i)", function(this, p, q, r, i)
  this:width(width):paint(math.floor(i / 8 ^ level * COLORS) + 1)
  local here = p
  local function go(place)
    this:face(place - here)
    this:forward(place:distance(here))
    here = place
  end
  local back, on = (p - q) * round, (r - q) * round
  for k = 0, pieces do
    local angle = k / pieces * math.pi / 2
    go(q + back * (1 - math.sin(angle)) + on * (1 - math.cos(angle)))
  end
  go(r)
end)

curve:derive()
