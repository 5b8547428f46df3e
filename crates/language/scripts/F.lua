-- A line that is drawn, a gap, and a line again.
local line = lsystem({ object = turtle({ step = 2 }) })
line:axiom(F(), G(0.5), F(1))
line:derive()
