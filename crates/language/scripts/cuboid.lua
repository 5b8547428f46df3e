-- The simple shapes, and their volumes or areas.
print(cuboid(4, 3, 2):volume(), cylinder(1, 2):volume(), cone(1, 2, 64):volume(), ball(1):volume())
print(revolve({ { 0, 0 }, { 2, 0 }, { 1.2, 1 }, { 1.5, 3 }, { 0, 3 } }):volume())
print(rectangle(4, 3):area(), disk(1, 6):area())
