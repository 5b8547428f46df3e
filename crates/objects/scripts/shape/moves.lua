-- Moved, turned and scaled shapes, copies, and a column fitted to a niche.
local block = cuboid(2, 1, 4)
print(block:translate(vec(5, 0, 0)):position(), block:rotate(90):shift(vec(1, 0, 0)):center())
print(block:rotate(90, nil, vec(0, 0, 0)):center())
print(block:resize(vec(4, 1, 4)):volume(), block:mirror(vec(1, 0, 0)):is_solid(), block:reverse():volume())
print(block:rotate(30, vec(0, 0, 1)):align():size(), #block:array(5, vec(3, 0, 0)))
print(cuboid(1, 1, 5):fit(cylinder(1, 2, 12)):size())
