--!strict
-- Diffusion along a stem from a source at its tip, with decay: each cell moves to the mean of its neighbours.
-- Source: L-Py, training/13c-flow1stem-diffusecontfromapexwithdeg, F. Boudon and C. Godin.
local cells = param("cells", { default = 20, min = 2, max = 60, step = 1, doc = "Number of cells" })
local steps = param("steps", { default = 1000, min = 0, max = 2000, step = 1, doc = "Steps" })
local decay = param("decay", { default = 0.01, min = 0, max = 0.2, doc = "Part that decays in a step" })
local speed = param("speed", { default = 0.5, min = 0, max = 0.5, doc = "Part that flows in a step" })
local SOURCE = 10

local Cell = module("Cell", "amount")

local stem = lsystem({ object = turtle({ sides = 16 }), interpret = "last" })
local chain = {}
for k = 1, cells do
  chain[k] = Cell(if k == cells then SOURCE else 0.01)
end
stem:axiom(table.unpack(chain))
stem:rule("Cell(a) < Cell(p) > Cell(b)", function(this, a: number, p: number, b: number)
  return Cell((p + (a + b - 2 * p) * speed) * (1 - decay))
end)
stem:rule("Cell(p) > Cell(b)", function(this, p: number, b: number)
  return Cell((p + (b - p) * speed) * (1 - decay))
end)
stem:interpret("Cell(amount)", function(this, amount)
  this:color(mix("#7aa860", "#d8402f", amount / SOURCE)):width(2):forward(2):width(0.4)
  this:turn(-90):color("#4763b0"):forward(1 + 2 * amount):advance(-1 - 2 * amount):turn(90)
end)
local result = stem:derive(steps)

-- In equilibrium p(k - 1) + p(k + 1) = 2 p(k) / 0.99, and nothing flows out of the first cell:
-- p(k) is in proportion to cosh((k - 1/2) b) with cosh b = 1 / 0.99.
local b = math.log(1 / 0.99 + math.sqrt(1 / 0.99 ^ 2 - 1))
local first = SOURCE * math.cosh(b / 2) / math.cosh(19.5 * b)
expect(tonumber(result.chains[1]:match("^Cell%(([%d.]+)%)")), first, 1e-3)
-- Picture: --azimuth 180 --elevation 0
