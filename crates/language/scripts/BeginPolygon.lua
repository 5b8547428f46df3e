-- A leaf: the turtle walks along the outline and marks each corner.
local leaf = lsystem({ object = turtle({ step = 1 }) })
leaf:axiom(BeginPolygon(), Point(), Turn(30), G(), Point(), Turn(-60), G(), Point(), EndPolygon())
leaf:derive()
