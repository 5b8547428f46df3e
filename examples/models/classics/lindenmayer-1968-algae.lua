--!strict
-- The filament of Lindenmayer's first L-system: a mature cell divides into a mature and a young cell, and a young cell
-- matures. The rows are the first stages, from top to bottom.
-- Source: A. Lindenmayer, Mathematical models for cellular interactions in development, 1968.
local stages = param("stages", { default = 6, min = 1, max = 12, step = 1, doc = "Number of stages" })

local Mature, Young = module("Mature"), module("Young")

local function filament(n: number): any
  local cells = lsystem({
    object = turtle({ position = { 0, 0, -1.5 * n }, heading = { 1, 0, 0 }, width = 1, sides = 12 }),
    interpret = "last",
  })
  cells:axiom(Young())
  cells:rule("Mature", function()
    return Mature(), Young()
  end)
  cells:rule("Young", function()
    return Mature()
  end)
  cells:interpret("Mature", function()
    return Color("#3f8a4a"), F(1.9), G(0.1)
  end)
  cells:interpret("Young", function()
    return Color("#a8cf5a"), F(0.9), G(0.1)
  end)
  return cells:derive(n)
end

-- The numbers of cells are Fibonacci numbers, and so are those of mature and of young cells.
local young, mature = 1, 0
for n = 0, stages do
  local counts = filament(n).counts
  expect(counts.Young, young)
  expect(counts.Mature, mature)
  young, mature = mature, mature + young
end
-- Picture: --azimuth 180 --elevation 0
