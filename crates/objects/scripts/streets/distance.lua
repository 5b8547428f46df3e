-- The distance from a position to the nearest street.
local lanes = streets({ { { 0, -5 }, { 40, -5 } } })
print(lanes:distance(vec(10, 3, 0)))
