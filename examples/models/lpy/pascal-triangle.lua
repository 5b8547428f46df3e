--!strict
-- Pascal's triangle: each number becomes the sum of itself and its left neighbour, and the row grows at its end.
-- Odd numbers are dark, and form the Sierpinski triangle. Each row is a derivation of its own.
-- Source: L-Py, models/pascaltriangle, F. Boudon and C. Godin.
local rows = param("rows", { default = 32, min = 1, max = 48, step = 1, doc = "Number of rows" })

local Number = module("Number", "value")

local function row(n: number): any
  local system = lsystem({
    object = turtle({ position = { -n / 2, 0, -n * 0.87 }, heading = { 1, 0, 0 }, sides = 6 }),
    interpret = "last",
  })
  system:axiom(Number(1))
  system:rule("Number(a) < Number(b) > Number(c)", function(this, a: number, b: number)
    return Number(a + b)
  end)
  system:rule("Number(a) < Number(b)", function(this, a, b)
    return Number(a + b), Number(b)
  end)
  system:rule("Number(a) > Number(b)", function(this, a)
    return Number(a)
  end)
  system:rule("Number(a)", function(this, a)
    return Number(a), Number(a)
  end)
  system:interpret("Number(value)", function(this, value)
    this:color(if value % 2 == 1 then "#35406f" else "#e3c98a"):sphere(0.45):advance(1)
  end)
  return system:derive(n)
end

for n = 0, rows - 1 do
  local numbers, sum = row(n), 0
  for value in numbers.chains[1]:gmatch("%d+") do
    sum += tonumber(value) :: number
  end
  -- The row n has n + 1 numbers with the sum 2^n.
  expect(numbers.counts.Number, n + 1)
  expect(sum, 2 ^ n)
end
-- Picture: --azimuth 180 --elevation 0
