-- The sizes of walls: a fixed panel, and walls that stretch, repeat or form a row.
local pane = panel({ width = 2, height = 3 })
local walls = {
  pane,
  grid(pane),
  list({ pane, panel({ width = 1, height = 3 }) }),
  bordered(pane, { left = 0.2, right = 0.2 }),
  extruded(pane, { depth = 0.2 }),
}
for _, wall in walls do
  print(wall:min_width(), wall:max_width(), wall:min_height(), wall:max_height(), wall:fits(4, 3))
end
