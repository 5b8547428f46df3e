--!strict
-- Growth functions: the filaments of this L-system have 1, 4, 9, 16, ... cells. The rows are its stages.
-- Source: A. Szilard, Growth functions of Lindenmayer systems, 1971.
local stages = param("stages", { default = 6, min = 1, max = 12, step = 1, doc = "Number of stages" })

local COLORS: { [string]: string } = { A = "#c03a3f", B = "#e0a83f", C = "#3f7f6a" }
local A, B, C = module("A"), module("B"), module("C")

local function filament(n: number): any
  local cells = lsystem({
    object = turtle({ position = { 0, 0, -3 * n }, heading = { 1, 0, 0 }, width = 1.6, sides = 12 }),
    interpret = "last",
  })
  cells:axiom(A())
  cells:rule("A", function()
    return A(), B(), C(), C()
  end)
  cells:rule("B", function()
    return B(), C(), C()
  end)
  for name, color in COLORS do
    cells:interpret(name, function()
      return Color(color), F(0.9), G(0.1)
    end)
  end
  return cells:derive(n)
end

-- A stage adds one B and two C for A, and two C for each B: in the stage n, there are A, n times B, and n (n + 1) times C.
for n = 0, stages do
  local cells = filament(n)
  expect(cells.modules, (n + 1) ^ 2)
  expect(cells.counts.B, n)
  expect(cells.counts.C, n * (n + 1))
end
-- Picture: --azimuth 180 --elevation 0
