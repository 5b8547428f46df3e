-- Solids over faces, with cut and rounded edges.
local face = disk(2, 8)
print(face:taper(3):volume(), face:taper(3, 0.5):volume(), face:extrude(2, vec(0.2, 0, 1)):volume())
print(face:molding({ { 0, 0 }, { 0.4, 0 }, { 0.4, 0.2 }, { 0, 0.2 } }):volume())
print(face:loft(face:rotate(20):translate(vec(0, 0, 3))):is_solid())
print(cuboid(4, 3, 2):chamfer(0.2, "corner"):volume(), cuboid(4, 3, 2):fillet(0.3, "corner", 6):volume())
local window = cuboid(6, 1, 3):faces("front")[1]:crop(2, 0.8, 1.2, 1.6)
print(if window then window:recess(0.2):area() else 0)
