-- A row of combs: each of the 8 teeth is there with probability 0.7.
local Comb = module("Comb", "x")
local row = lsystem({ object = extruder({ sides = 4 }) })
row:axiom({ Comb(0) }, { Comb(3) }, { Comb(6) })
row:interpret("Comb(x)", function(this, x)
  local teeth = binomial(8, 0.7)
  this:jump({ x, 0, 0 })
  for _ = 1, teeth do
    this:scale(0.9):extrude(0.5)
  end
end)
row:derive()
