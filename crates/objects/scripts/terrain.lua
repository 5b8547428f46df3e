local hills = { A = { "A", "A", "A", "A", change = { 0.2, -0.1, 0.1, -0.2 }, decay = 0.5 } }
local land = lsystem({
  object = terrain({ size = 512, levels = 6, rules = hills, covers = { { color = "#5b7a3a" } } }),
})
land:derive()
