-- Set operations of solids, and a block cut by a plane.
local block, hole = cuboid(4, 4, 4), cylinder(1, 6):translate(vec(2, 2, -1))
local rest, both, all = block:subtract(hole), block:intersect(hole), block:union(hole)
print(if rest then rest:volume() else 0, if both then both:volume() else 0, if all then all:volume() else 0)
local half = block:trim(vec(2, 2, 2), vec(1, 0, 1))
print(if half then half:volume() else 0)
