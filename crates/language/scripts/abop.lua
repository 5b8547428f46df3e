-- The plant of figure 1.24 e of The Algorithmic Beauty of Plants. Each third apex stops at random.
local plant = abop({
  axiom = "X",
  X = { { 2, "F[+X][-X]FX" }, { 1, "F" } },
  F = "FF",
  angle = 25.7,
  step = 0.1,
  width = 0.05,
})
plant:derive(5)
