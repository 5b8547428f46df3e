-- A line, a gap, and another line.
local line = lsystem({ object = turtle({ step = 2 }) })
line:axiom(F(), G(0.5), F(1))
line:derive()
