-- A river from its source down the slopes.
local hills = { A = { "A", "A", "A", "A", change = { 0.12, -0.06, 0.06, -0.12 }, decay = 0.55 } }
local land = terrain({ size = 512, levels = 7, rules = hills, covers = { { color = "#7d8f5a" } } })
local Ground = module("Ground")
local lands = lsystem({ object = land })
lands:axiom(Ground())
lands:interpret("Ground", function(this)
  this:river({ 0, 0 }, 12)
end)
lands:derive()
