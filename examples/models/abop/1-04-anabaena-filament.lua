--!strict
-- A filament of Anabaena catenula: a long cell divides into a long and a short one, in the order of its polarity. The
-- rows show the axiom and the next steps.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.4.
local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps of the last row" })

local Long, Short = module("Long", "polarity"), module("Short", "polarity") -- polarity: 1 right, -1 left
local FIBONACCI = { 1, 1, 2, 3, 5, 8, 13, 21, 34, 55 }

local function filament(n: number): any
  local row = turtle({ position = { 0, 0, -n * 1.6 }, width = 1, sides = 12 })
  local system = lsystem({ object = row, interpret = "last" })
  system:axiom(Right(), Long(1))
  system:rule("Long(p)", function(this, p: number)
    if p > 0 then
      return Long(-1), Short(1)
    end
    return Short(-1), Long(1)
  end)
  system:rule("Short(p)", "Long(p)")
  -- The darker end shows the polarity.
  local ends = { "#8fbf6a", "#3f7a3a" }
  local function cell(length: number)
    return function(this: any, p: number)
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

-- A row as letters: l and s for a long and a short cell that point to the left, L and S to the right.
local function letters(chain: string): string
  local row = ""
  for name, polarity in chain:gmatch("(%a+)%((%-?1)%)") do
    local letter = if name == "Long" then "l" else "s"
    row ..= if polarity == "1" then letter:upper() else letter
  end
  return row
end
local MIRRORED: { [string]: string } = { l = "L", L = "l", s = "S", S = "s" }
local function mirror(row: string): string
  return (row:reverse():gsub("%a", MIRRORED))
end

local rows: { string } = {}
for n = 0, steps do
  local derived = filament(n)
  -- The numbers of long and of short cells are Fibonacci numbers.
  local long, short = FIBONACCI[n + 1], FIBONACCI[n] or 0
  expect({ derived.counts.Long or 0, derived.counts.Short or 0 }, { long, short })
  expect(derived.objects[1]:position().x, 1.5 * long + 0.8 * short, 1e-9)
  -- Each row is the mirror image of the row above, then the row above that one.
  local row = letters(derived.chains[1])
  expect(row, if n == 0 then "L" elseif n == 1 then "lS" else mirror(rows[n]) .. rows[n - 1])
  table.insert(rows, row)
end

-- Picture: --azimuth 180 --elevation 0
