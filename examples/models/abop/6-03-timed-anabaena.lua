--!strict
-- The filament of Anabaena in continuous time: cells divide at an age, and grow exponentially until then. A film:
-- burgeon run examples/models/abop/6-03-timed-anabaena.lua --frames 0:7:0.05 --elevation 0 -o anabaena.gif
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, section 6.1 and figure 6.3.
local time = param("time", { default = 7, min = 0, max = 9, doc = "Time, in lives of a cell" })
local rows =
  param("rows", { default = 15, min = 1, max = 30, step = 1, doc = "Rows, each at an earlier time" })

local GOLDEN = (1 + math.sqrt(5)) / 2

-- A long cell and a short cell, each with its age and its polarity: the side of the long daughter.
local Long, Short = module("Long", "age", "side"), module("Short", "age", "side")

local function filament(at: number, height: number): Derived
  local pen = turtle({ position = { 0, 0, height }, heading = { 1, 0, 0 }, sides = 12 })
  local system = lsystem({ object = pen })
  system:axiom(Long(at, 1))
  system:decompose("Long(age, side)", {
    when = function(this, age)
      return age >= 1
    end,
  }, function(this, age, side)
    local long, short = Long(age - 1, -side), Short(age - 1, side)
    if side == 1 then
      return long, short
    end
    return short, long
  end)
  system:decompose("Short(age, side)", {
    when = function(this, age)
      return age >= 1
    end,
  }, function(this, age, side)
    return Long(age - 1, side)
  end)
  -- A cell begins with the length that its parent ends with: 1 at the age 0 of a long cell.
  local function draw(this: Turtle, length: number, color: string)
    this:color(color):advance(0.08 * length):width(0.5):forward(0.84 * length):advance(0.08 * length)
  end
  system:interpret("Long(age, side)", function(this, age)
    draw(this, GOLDEN ^ age, "#4f8f5a")
  end)
  system:interpret("Short(age, side)", function(this, age)
    draw(this, GOLDEN ^ (age - 1), "#c9b458")
  end)
  return system:derive(0)
end

for row = 0, rows - 1 do
  local at = time * (1 - row / rows)
  local result = filament(at, row)
  -- Divisions change no length, so the filament grows by the golden ratio in a life of a cell.
  expect(result.objects[1]:position().x, GOLDEN ^ at, 1e-9)
  if row == 0 then
    -- The numbers of cells are Fibonacci numbers.
    expect(result.counts, { Long = 21, Short = 13 })
  end
end
-- Picture: --azimuth 180 --elevation 0
