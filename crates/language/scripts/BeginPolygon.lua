-- A leaf: the turtle walks around it and leaves a point at each corner.
local leaf = lsystem({ object = turtle({ step = 1 }) })
leaf:axiom(BeginPolygon(), Point(), Turn(30), G(), Point(), Turn(-60), G(), Point(), EndPolygon())
leaf:derive()
