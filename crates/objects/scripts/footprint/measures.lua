-- The shape measures of a footprint, and the height of its ground.
local plan = footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }, { height = 6 })
print(plan:area(), plan:perimeter(), plan:convexity(), plan:height())
print(plan:lowest(), plan:highest())
