-- A test for a frontage of 8 m by 9 m that contains only windows.
local windows = template(grid(panel({ width = 2, height = 3 })))
print(facade({ windows }):fits(8, 9))
