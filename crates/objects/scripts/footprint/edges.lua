-- The length, the start and the direction of each edge, and its keyword "street".
local lane = streets({ { { -5, -4 }, { 15, -4 } } })
local plan = footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }, { streets = lane })
for edge = 1, plan:edges() do
  print(edge, plan:edge_length(edge), plan:edge_start(edge))
  print(plan:edge_facing(edge), plan:edge_has(edge, "street"))
end
print(plan:street_edge())
