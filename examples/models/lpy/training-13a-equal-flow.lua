--!strict
-- Flow between cells with random contents: each exchange moves a part of the difference, until all cells have the mean.
-- The grey bars are the contents at the beginning.
-- Source: L-Py, training/13a-flow1stem-random, F. Boudon and C. Godin.
local cells = param("cells", { default = 12, min = 2, max = 40, step = 1, doc = "Number of cells" })
local steps = param("steps", { default = 600, min = 0, max = 2000, step = 1, doc = "Steps" })
local speed =
  param("speed", { default = 1 / 3, min = 0, max = 0.5, doc = "Part of the difference that flows" })

local Cell = module("Cell", "amount", "start")

local stem = lsystem({ object = turtle({ sides = 16 }), interpret = "last" })
local chain, total = {}, 0
for k = 1, cells do
  local amount = random(0, 10)
  chain[k] = Cell(amount, amount)
  total += amount
end
stem:axiom(table.unpack(chain))
stem:rule(
  "Cell(a, i) < Cell(p, start) > Cell(b, j)",
  function(this, a: number, i: number, p: number, start: number, b: number)
    return Cell(p + (a + b - 2 * p) * speed, start)
  end
)
stem:rule("Cell(p, start) > Cell(b, j)", function(this, p: number, start: number, b: number)
  return Cell(p + (b - p) * speed, start)
end)
stem:rule("Cell(a, i) < Cell(p, start)", function(this, a: number, i: number, p: number, start: number)
  return Cell(p + (a - p) * speed, start)
end)
stem:interpret("Cell(amount, start)", function(this, amount, start)
  local function bar(angle, color, length)
    return { Turn(angle), Width(0.8), Color(color), G(0.8), F(length) }
  end
  return Color(mix("#7aa860", "#d8402f", amount / 10)),
    Width(1.2),
    F(1),
    bar(-90, "#4763b0", amount),
    bar(90, "#9a9a9a", start)
end)
local result = stem:derive(steps)

-- The flow keeps the total, so all cells approach the mean.
for amount in result.chains[1]:gmatch("Cell%(([%d.e-]+)") do
  expect(tonumber(amount), total / 12, 1e-3)
end
-- Picture: --azimuth 180 --elevation 0
