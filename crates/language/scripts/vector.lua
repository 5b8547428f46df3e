-- Operations on two vectors.
local along, across = vec(3, 4, 0), vec(-4, 3, 0)
print(along:dot(across), along:cross(across), along:length(), along:unit())
print(along:distance(across), along:lerp(across, 0.5), (along + across) / 2)
