local window =
  bordered(panel({ material = { color = "#203040" } }), { left = 0.2, right = 0.2, top = 0.3, bottom = 0.9 })
print(window:fits(1.4, 3))
