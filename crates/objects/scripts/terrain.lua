local hills = { A = { "A", "A", "A", "A", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }
local land = lsystem({
  object = terrain({ size = 512, levels = 6, rules = hills, covers = { { color = "#5b7a3a" } } }),
})
land:derive()
