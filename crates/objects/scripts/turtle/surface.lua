-- A petal as a Bezier patch: as it is, and with twice the length.
local petal = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-0.6, 0.2, 0.4), vec(-0.2, 0, 0.4), vec(0.2, 0, 0.4), vec(0.6, 0.2, 0.4) },
  { vec(-0.8, 0.1, 0.9), vec(-0.3, -0.3, 0.9), vec(0.3, -0.3, 0.9), vec(0.8, 0.1, 0.9) },
  { vec(0, 0.6, 1.3), vec(0, 0.6, 1.3), vec(0, 0.6, 1.3), vec(0, 0.6, 1.3) },
})
local Part = module("Part")
local parts = lsystem({ object = turtle({ color = "#b0568a" }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this:surface(petal):jump(vec(2, 0, 0)):surface(petal, vec(1, 1, 2))
end)
parts:derive()
