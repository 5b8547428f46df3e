-- A cone on a box.
local row = lsystem({ object = extruder({ color = "#a9855c" }) })
row:axiom(Draw(cuboid(3, 3, 2)), Draw(cone(1.5, 2):translate(vec(1.5, 1.5, 2))))
row:derive()
