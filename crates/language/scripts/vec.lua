-- A place 3 m east and 4 m north, and one twice as far.
local place = vec(3, 4, 0)
print(place * 2, place:length())
