-- The value, the slope and the integral of a function, and a function halfway to another.
local rate = ramp({ { 0, 0 }, { 1, 2 }, { 3, 0.5 } }, { kind = "linear" })
print(rate:at(0.5), rate:slope(0.5), rate:integral(0, 3))
local even = ramp({ { 0, 1 }, { 3, 1 } })
print(rate:mix(even, 0.5):at(1))
