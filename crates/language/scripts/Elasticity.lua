-- Branches with increasing downward bending.
local twigs = lsystem({ object = turtle({ step = 1, tropism = { 0, 0, -1 } }) })
twigs:axiom({ Turn(60), Elasticity(0.1), F(), F(), F() }, { Turn(-60), Elasticity(0.4), F(), F(), F() })
twigs:derive()
