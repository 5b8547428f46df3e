--!strict
-- The Peano curve: each of the nine ninths of a square is crossed from corner to corner.
-- Source: L-Py, tutorial/02 - fractals/peanocurve, F. Boudon and C. Godin.
local steps =
  param("steps", { default = 3, min = 1, max = 4, step = 1, doc = "How often the square is divided" })
local color = param("color", { default = "#8a3f7a", doc = "Colour of the curve" })

local Cell = module("Cell", "side") -- crosses a square to the corner on its left (1) or right (-1)

local curve = lsystem({ object = turtle({ width = 0.35, color = color, sides = 6 }), interpret = "last" })
curve:axiom(Cell(1))
curve:rule("Cell(s)", function(this, s)
  local column = { Cell(s), F(1), Cell(-s), F(1), Cell(s) }
  local back = { Cell(-s), F(1), Cell(s), F(1), Cell(-s) }
  local chain = {}
  local function add(parts: any)
    table.move(parts, 1, #parts, #chain + 1, chain)
  end
  add(column)
  add({ Turn(90 * s), F(1), Turn(90 * s) })
  add(back)
  add({ Turn(-90 * s), F(1), Turn(-90 * s) })
  add(column)
  return table.unpack(chain)
end)
local result = curve:derive(steps)

-- The curve joins 9^n cells, and ends at the opposite corner of the square.
expect(result.counts.F, 9 ^ 3 - 1)
expect(result.objects[1]:position():distance(vec(-26, 0, 26)), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
