--!strict
-- A cellular automaton as an L-system: each cell becomes the sum of its neighbours modulo 2 (rule 90). A cell remembers
-- its former states, so that the last chain shows all steps.
-- Source: S. Wolfram, Statistical mechanics of cellular automata, 1983.
local steps = param("steps", { default = 31, min = 0, max = 63, step = 1, doc = "Number of steps" })
local rule = param("rule", { default = 90, min = 0, max = 255, step = 1, doc = "Number of the rule" })

local Cell = module("Cell", "state", "history")

local automaton = lsystem({
  object = turtle({ heading = { 1, 0, 0 }, width = 1.3, sides = 4, color = "#2f3f6f" }),
  interpret = "last",
})
local row = {}
for k = -steps - 1, steps + 1 do
  table.insert(row, Cell(if k == 0 then 1 else 0, ""))
end
automaton:axiom(table.unpack(row))
automaton:rule(
  "Cell(a, x) < Cell(b, history) > Cell(c, y)",
  function(this, a: number, x: number, b: number, history: string, c: number)
    return Cell(bit32.extract(rule, 4 * a + 2 * b + c), history .. b)
  end
)
automaton:interpret("Cell(state, history)", function(this, state, history)
  local past = history .. state
  local column: any = { Right(90), Roll(45) }
  for k = 1, #past do
    table.insert(column, if past:sub(k, k) == "1" then F(1) else G(1))
  end
  return column, G(1)
end)
local result = automaton:derive(steps)

-- The row n of rule 90 has as many cells as Pascal's triangle has odd numbers: 2^k for k ones in the binary digits of n.
-- 31 has five ones.
local _, living = result.chains[1]:gsub("Cell%(1", "")
expect(living, 2 ^ 5)
-- Picture: --azimuth 180 --elevation 0
