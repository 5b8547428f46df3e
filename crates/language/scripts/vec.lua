-- A position 3 m east and 4 m north, and a position at twice the distance.
local place = vec(3, 4, 0)
print(place * 2, place:length())
