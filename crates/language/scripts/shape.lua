-- A plan with a courtyard as a mass, and a mesh of four triangles.
local plan =
  shape({ { { 0, 0 }, { 20, 0 }, { 20, 12 }, { 0, 12 } }, { { 5, 4 }, { 12, 4 }, { 12, 8 }, { 5, 8 } } }, 2)
print(plan:extrude(9):volume())
local points = { vec(0, 0, 0), vec(2, 0, 0), vec(0, 2, 0), vec(0, 0, 2) }
print(shape({ points = points, faces = { { 1, 3, 2 }, { 1, 2, 4 }, { 1, 4, 3 }, { 2, 3, 4 } } }):is_solid())
