-- A line through three points.
local path = line(vec(0, 0), vec(3, 4), vec(3, 10))
print(path:length())
