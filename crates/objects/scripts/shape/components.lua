-- The faces, edges, holes and pieces of a roof and a plan.
local roof = rectangle(12, 8):roof({ kind = "hip", height = 3 })
for _, face in roof:faces("slanted") do
  print(face:slope(), face:matches("south"), face:has_tag("roof.slope"))
end
for _, face in roof:components("faces", { "tag:roof.slope", "down" }) do
  print(face:entry(), face:area())
end
print(#roof:edges("ridge"), #roof:edges("hip"), roof:edges("ridge")[1]:edge_kind())
local yard =
  shape({ { { 0, 0 }, { 20, 0 }, { 20, 12 }, { 0, 12 } }, { { 5, 4 }, { 12, 4 }, { 12, 8 }, { 5, 8 } } })
print(#yard:holes(), yard:without_holes():area(), yard:geometry():area())
local slopes = roof:joined_faces("slanted")
print(
  #shape({ cuboid(2, 2, 2), ball(1):translate(vec(9, 0, 0)) }):pieces(),
  if slopes then slopes:area() else 0
)
