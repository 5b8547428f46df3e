--!strict
-- A filament of Anabaena catenula: a long cell divides into a long and a short one, in the order of its polarity. The
-- rows show the axiom and the next steps.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.4.
local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps of the last row" })

local Long, Short = module("Long", "polarity"), module("Short", "polarity") -- polarity: 1 right, -1 left
local FIBONACCI = { 1, 2, 3, 5, 8, 13, 21, 34, 55, 89 }

local function filament(n: number)
  local row = turtle({ position = { 0, 0, -n * 1.6 }, width = 1, sides = 12 })
  local system = lsystem({ object = row, interpret = "last" })
  system:axiom(Right(), Long(1))
  system:rule("Long(p)", function(this, p)
    if p > 0 then
      return Long(-1), Short(1)
    end
    return Short(-1), Long(1)
  end)
  system:rule("Short(p)", function(this, p)
    return Long(p)
  end)
  -- The darker end shows the polarity.
  local ends = { "#8fbf6a", "#3f7a3a" }
  local function cell(length: number)
    return function(this, p)
      this:advance(0.1)
      for half = 1, 2 do
        this:color(ends[if p > 0 then half else 3 - half]):forward(length / 2)
      end
    end
  end
  system:interpret("Long(p)", cell(1.4))
  system:interpret("Short(p)", cell(0.7))
  return system:derive(n)
end

for n = 0, steps do
  local counts = filament(n).counts
  -- The numbers of cells are Fibonacci numbers.
  expect((counts.Long or 0) + (counts.Short or 0), FIBONACCI[n + 1])
end

-- Picture: --azimuth 180 --elevation 0
