--!strict
-- Looks into a run: print, the counts of the final chain, and a check of a known result.
local Cell = module("Cell", "age")

local filament = lsystem({ object = turtle({ color = "#5f9ea0", sides = 20 }) })

filament:axiom(Cell(0))
filament:rule("Cell(age)", function(this, age)
  if age == 0 then
    return Cell(1)
  end
  return Cell(1), Turn(9), Cell(0)
end)
filament:interpret("Cell(age)", function(this, age)
  this:width(if age == 1 then 0.5 else 0.3):sphere(if age == 1 then 0.32 else 0.2):forward(0.45)
end)

-- Hooks see the state of the derivation after each step.
filament:after_step(function(now)
  print(`step {now.step}: {now.modules} modules, {now.counts.Cell} cells`)
end)

local grown = filament:derive(7)
print(grown.chains[1])
-- The cells are Fibonacci numbers. The run fails if they are not.
expect(grown.counts.Cell, 21)
