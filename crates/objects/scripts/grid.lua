local windows = grid(panel({ width = 2, height = 3 }))
print(windows:fits(8, 9))
