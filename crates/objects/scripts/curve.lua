-- Beads along a guide curve.
local guide = curve({ vec(0, 0, 0), vec(0.5, 0, 1), vec(0, 0.5, 2), vec(0, 0, 3) })
local Bead = module("Bead", "number")
local chain = lsystem({ object = turtle({ color = "#b0568a" }) })
chain:axiom(sequence({ Bead(0), Bead(1), Bead(2), Bead(3), Bead(4), Bead(5), Bead(6) }))
chain:interpret("Bead(number)", function(this, number)
  this:jump(guide:point(number / 6)):face(guide:tangent(number / 6)):sphere(0.12)
end)
chain:derive()
