local lanes = streets({ { { 0, -5 }, { 40, -5 } } })
local plan = footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }, { streets = lanes })
print(plan:street_edge())
