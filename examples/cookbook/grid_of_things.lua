--!strict
-- A field of columns whose heights follow smooth noise: two loops, and a branch for each column.
local size = param("size", { default = 26, min = 4, max = 60, step = 1, doc = "Columns in a row" })

local Column = module("Column", "x", "y")

local field = lsystem({ object = extruder({ sides = 6, smooth = false }) })

local columns = {}
for row = 0, size - 1 do
  for column = 0, size - 1 do
    -- Every other row is shifted, as in a honeycomb.
    table.insert(columns, { Column(column * 1.74 + row % 2 * 0.87, row * 1.5) })
  end
end
field:axiom(sequence(columns))

field:interpret("Column(x, y)", function(this, x, y)
  local height = 4 + 3.5 * noise(x / 11, y / 11) + noise(x / 3, y / 3)
  local part = math.clamp((height - 1) / 6, 0, 1)
  local color = if part < 0.6
    then mix("#1f4e5f", "#e7d9a6", part / 0.6)
    else mix("#e7d9a6", "#b5523b", part / 0.4 - 1.5)
  this:jump({ x, y, 0 }):roll(30):color(color):scale(0.97):extrude(math.max(height, 0.3))
end)

field:derive()
