-- A road of 20 m, with slopes of 20 m on both sides.
local hills = { A = { "A", "A", "A", "A", change = { 0.12, -0.06, 0.06, -0.12 }, decay = 0.55 } }
local land = terrain({ size = 512, levels = 7, rules = hills, covers = { { color = "#7d8f5a" } } })
local Ground = module("Ground")
local lands = lsystem({ object = land })
lands:axiom(Ground())
lands:interpret("Ground", function(this)
  this:cut({ { -256, -100 }, { 0, 0 }, { 256, 60 } }, 20, 20)
end)
lands:derive()
