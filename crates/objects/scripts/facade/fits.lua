-- Whether a front of 8 m by 9 m can be made of windows alone.
local windows = template(grid(panel({ width = 2, height = 3 })))
print(facade({ windows }):fits(8, 9))
