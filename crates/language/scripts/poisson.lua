-- A row of stems with 4 rings each on average.
local Stem = module("Stem", "x")
local Ring = module("Ring")
local row = lsystem({ object = extruder({ sides = 10 }) })
row:axiom({ Stem(0) }, { Stem(3) }, { Stem(6) })
row:rule("Stem(x)", function(this, x)
  local rings = { Stem(x) }
  for _ = 1, poisson(4) do
    table.insert(rings, Ring())
  end
  return table.unpack(rings)
end)
row:interpret("Stem(x)", function(this, x)
  this:jump({ x, 0, 0 })
end)
row:interpret("Ring", function(this)
  this:scale(0.9):extrude(0.2):extrude(0.6)
end)
row:derive(1)
