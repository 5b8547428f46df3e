local front = template(grid(panel({ width = 2, height = 3 })), { keywords = { "street" } })
print(front:fits(8, 9))
