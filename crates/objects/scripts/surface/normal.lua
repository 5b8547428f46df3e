-- Positions and normals of a quarter of a cylinder, which is exact with NURBS.
local quarter = surface({
  points = {
    { vec(1, 0, 0), vec(1, 1, 0), vec(0, 1, 0) },
    { vec(1, 0, 2), vec(1, 1, 2), vec(0, 1, 2) },
  },
  kind = "nurbs",
  weights = { { 1, math.sqrt(0.5), 1 }, { 1, math.sqrt(0.5), 1 } },
})
print(quarter:point(0.5, 0.5):length(), quarter:normal(0.5, 0.5))
print(quarter:mix(quarter, 0.5):point(1, 1))
