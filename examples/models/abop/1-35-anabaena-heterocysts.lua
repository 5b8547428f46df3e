--!strict
-- Anabaena with heterocysts: cells grow and divide. A compound that suppresses heterocysts diffuses from them and
-- decays, and a short cell with little of it becomes a heterocyst, blue. There are eleven steps between rows.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.35.
local rows = param("rows", { default = 14, min = 3, max = 15, step = 1, doc = "Rows of the picture" })
local HIGH = 900 -- concentration in heterocysts
local LOW = 0.4 -- concentration below which a cell differentiates
local LENGTH = 3.9 -- length above which a cell does not differentiate

-- State 0 is a heterocyst; the longer daughter is to the left in state 1, and to the right in state 2.
local Cell, Gap = module("Cell", "length", "state", "level"), module("Gap")

-- Adds the axiom and the rules of a filament to a system.
local function add_filament<T>(system: System<T>)
  system:ignore("Gap")
  system:axiom(Right(), Cell(0, 0, HIGH), Gap(), Cell(4, 1, HIGH), Gap(), Cell(0, 0, HIGH))
  system:rule("Cell(a, i, before) < Cell(length, state, level) > Cell(b, j, after)", {
    when = function(this, a, i, before, length, state)
      return state > 0
    end,
  }, function(this, a, i, before, length, state, level, b, j, after)
    if length >= 6 then
      local long, short = Cell(length * 2 / 3, 3 - state, level), Cell(length / 3, state, level)
      if state == 1 then
        return long, Gap(), short
      end
      return short, Gap(), long
    elseif length > LENGTH or level > LOW then
      return Cell(length + 0.1, state, level + 0.25 * (before + after - 3 * level))
    end
    return Cell(0, 0, HIGH)
  end)
end

-- The places of the heterocysts, then the level of the first other cell and the number of cells.
local function measure(chain: string): ({ number }, number, number)
  local number, heterocysts: { number }, first = 0, {}, 0
  for state, level in chain:gmatch("Cell%([^,]+,(%d),([^)]+)%)") do
    number += 1
    if state == "0" then
      table.insert(heterocysts, number)
    elseif number == 2 then
      first = tonumber(level) :: number
    end
  end
  return heterocysts, first, number
end

-- A cell of 4 has grown to 6 after 20 steps, and has divided after 22, in two rows; its short daughter of 2 needs twice
-- as many. So two rows each have a Fibonacci number of cells, besides the heterocysts at the ends.
local last, before = 1, 1
for row = 0, rows - 1 do
  local pen = turtle({ position = { 0, 0, -row * 7 }, width = 3 })
  local system = lsystem({ object = pen, interpret = "last" })
  add_filament(system)
  system:interpret("Gap", function(this)
    this:advance(0.5)
  end)
  system:interpret("Cell(length, state, level)", function(this, length: number, state: number, level: number)
    if state == 0 then
      this:color("#2f5fb0"):advance(2)
      this:sphere(2)
      this:advance(2)
    else
      this:color(mix("#d5e39a", "#3f7a3a", math.min(level / HIGH * 4, 1))):forward(length)
    end
  end)
  local chain = system:derive(row * 11).chains[1]
  local heterocysts, level, number = measure(chain)
  expect(number, 2 + last)
  if row % 2 == 1 then
    last, before = last + before, last
  end
  expect(heterocysts, if row < 13 then { 1, number } else { 1, 12, 23 })
  -- A single cell between heterocysts: c(n + 1) = c(n) / 4 + 450, so c(n) = 600 + 300 / 4^n.
  if row < 2 then
    expect(level, 600 + 300 / 4 ^ (row * 11), 1e-9)
  end
end
-- The first new heterocyst is in the middle, where there is least of the compound, and appears in step 138.
for _, step in { 137, 138 } do
  local system = lsystem()
  add_filament(system)
  local heterocysts = measure(system:derive(step).chains[1])
  expect(#heterocysts, if step < 138 then 2 else 3)
end

-- Picture: --azimuth 180 --elevation 0
