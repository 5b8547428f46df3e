-- A berry at the end of a stem.
local berry = lsystem({ object = turtle({ width = 0.05 }) })
berry:axiom(F(1), Sphere(0.2))
berry:derive()
