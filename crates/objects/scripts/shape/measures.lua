-- A mass: its scope, its measures, and those of its front.
local mass = cuboid(12, 8, 6):translate(vec(4, 0, 0))
print(mass:size(), mass:position(), mass:center(), mass:volume(), mass:area(), mass:is_solid())
print(mass:face_count(), mass:open_edges(), #mass:points())
local front = mass:faces("front")[1]
print(front:x_axis(), front:y_axis(), front:z_axis(), front:slope(), front:length())
