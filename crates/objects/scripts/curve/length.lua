-- Positions and directions by the part of the length, and a curve halfway to another.
local bud = curve({ vec(0.1, 0), vec(0, 0.1), vec(-0.1, 0), vec(0, -0.1) }, { closed = true })
local leaf = curve({ vec(1, 0), vec(0, 0.2), vec(-1, 0), vec(0, -0.2) }, { closed = true })
print(leaf:length(), leaf:point(0.25), leaf:tangent(0.25))
print(bud:mix(leaf, 0.5):length())
