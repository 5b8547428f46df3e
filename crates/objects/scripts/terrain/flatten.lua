-- A level area of 160 m at a height of 10 m, with a margin of 40 m.
local hills = { A = { "A", "A", "A", "A", change = { 0.12, -0.06, 0.06, -0.12 }, decay = 0.55 } }
local land = terrain({ size = 512, levels = 7, rules = hills, covers = { { color = "#7d8f5a" } } })
local Ground = module("Ground")
local lands = lsystem({ object = land })
lands:axiom(Ground())
lands:interpret("Ground", function(this)
  this:flatten({ { -80, -80 }, { 80, -80 }, { 80, 80 }, { -80, 80 } }, 10, 40)
end)
lands:derive()
