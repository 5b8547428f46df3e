local wall = panel({ width = { 1, 2, 3 }, height = 3, material = { color = "#c8b090" } })
print(wall:fits(2.5, 3))
