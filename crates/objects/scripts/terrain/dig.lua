-- A ditch, 20 m wide and 12 m deep.
local hills = { A = { "A", "A", "A", "A", change = { 0.12, -0.06, 0.06, -0.12 }, decay = 0.55 } }
local land = terrain({ size = 512, levels = 7, rules = hills, covers = { { color = "#7d8f5a" } } })
local Ground = module("Ground")
local lands = lsystem({ object = land })
lands:axiom(Ground())
lands:interpret("Ground", function(this)
  this:dig({ { -256, -100 }, { 0, 0 }, { 256, 60 } }, 20, 12)
end)
lands:derive()
