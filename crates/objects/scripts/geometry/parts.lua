-- A yard with a pond: its rings, its boundary, its parts, and a point inside.
local yard = polygon({
  { { 0, 0 }, { 20, 0 }, { 20, 10 }, { 0, 10 } },
  { { 4, 4 }, { 8, 4 }, { 8, 8 }, { 4, 8 } },
})
local ring, border = yard:exterior_ring(), yard:boundary()
print(ring and ring:wkt(), #yard:interior_rings(), #yard:segments(), yard:point_on_surface():wkt())
print(border:num_geometries(), #border:geometries(), border:is_empty())
