local cell = panel({ width = { 1.8, 2, 2.6 }, height = 3 })
-- As many cells as fit best: 4 columns and 3 rows of 2 by 3 m.
print(grid(cell):fits(8, 9))
-- 3 columns: 5.4 to 7.8 m wide.
local three = grid(cell, { columns = 3 })
print(three:min_width(), three:max_width())
