-- A rule asks the ground at a place, and the interpretation expands more of it there.
local Stand = module("Stand")
local hills = { A = { "A", "A", "A", "A", change = { 0.2, -0.1, 0.1, -0.2 }, decay = 0.5 } }
local land = lsystem({ object = terrain({ size = 512, levels = 6, rules = hills }) })
land:axiom(Stand())
land:rule("Stand", function(this)
  local place = vec(100, 100, 0)
  print(this:height(place), this:normal(place), this:slope(place), this:symbol(place), this:heights())
  return Stand()
end)
land:interpret("Stand", function(this)
  this:focus(100, 100, { cell = 32, rings = { { 1, 8 } } })
end)
land:derive(1)
