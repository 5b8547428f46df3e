local storeys = list({ panel({ height = 4 }), panel({ height = { 2, 3, 4 } }) }, { direction = "vertical" })
print(storeys:min_height())
