--!strict
-- Five plants of P. Hogeweg and P. Hesper: each cell is 0 or 1 and obeys its neighbours below and above. The outcome for
-- each of the eight neighbourhoods is a row of a table.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.31.
local height = param("height", { default = 1, min = 0.1, max = 10, unit = "m", doc = "Height of each plant" })

-- Outcomes for the bits 000 to 111 of the cells below, here and above: a bit, growth (G), or a branch to the left (L)
-- or to the right (R).
local PLANTS: { any } = {
  { axiom = "111", outcomes = { 0, "L", 1, 1, 0, "G", 0, 0 }, steps = 30, angle = 22.5 },
  { axiom = "111", outcomes = { 1, "R", 1, 1, 0, "G", 1, 0 }, steps = 30, angle = 22.5 },
  { axiom = "111", outcomes = { 0, 1, 0, "L", 0, "G", 0, 0 }, steps = 26, angle = 25.75 },
  { axiom = "011", outcomes = { 1, 0, 0, "G", 1, "L", 1, 0 }, steps = 24, angle = 25.75 },
  { axiom = "111", outcomes = { 0, "R", 1, 1, 0, "G", 1, 0 }, steps = 26, angle = 22.5 },
}

local Cell = module("Cell", "bit")

local function grow<T>(k: number, steps: number, system: System<T>): Derived
  local plant = PLANTS[k]
  system:axiom((plant.axiom:gsub(".", "F Cell(%0) ")))
  system:ignore("F", "Turn")
  system:rule(
    "Cell(below) < Cell(bit) > Cell(above)",
    function(this, below: number, bit: number, above: number)
      local outcome = plant.outcomes[below * 4 + bit * 2 + above + 1]
      if outcome == "G" then
        return Cell(1), F(), Cell(1)
      elseif outcome == "L" then
        return Cell(1), { Turn(plant.angle), F(), Cell(1), F(), Cell(1) }
      elseif outcome == "R" then
        return Cell(1), { Turn(-plant.angle), F(), Cell(1), F(), Cell(1) }
      end
      return Cell(outcome)
    end
  )
  -- Turns to the left and to the right alternate.
  system:rule("Turn(a)", "Turn(-a)")
  return system:derive(steps)
end

for k, plant in PLANTS do
  local stem = grow(k, plant.steps, lsystem()).chains[1]:gsub("%b[]", "")
  local _, segments = stem:gsub("F", "")
  local pen = turtle({
    step = height / segments,
    width = height / 160,
    position = { k * height * 0.6, 0, 0 },
    color = "#47742f",
    sides = 4,
  })
  local derived = grow(k, plant.steps, lsystem({ object = pen, interpret = "last" }))
  -- Each cell comes with its segment, and those outside of brackets are the stem.
  expect(derived.counts.F, derived.counts.Cell)
  expect(derived.objects[1]:position().z, 1, 1e-9)
end
-- By hand: 111, 101, 1111, 1001, 101[11]1.
expect(
  grow(1, 4, lsystem()).chains[1],
  "F Cell(1) F Cell(0) F Cell(1) [ Turn(22.5) F Cell(1) F Cell(1) ] F Cell(1)"
)

-- Picture: --azimuth 180 --elevation 5
