-- Positions along a path, by number and by fraction of its length.
local path = line(vec(0, 0), vec(3, 4), vec(3, 10))
print(path:start_point(), path:point_n(2), path:end_point(), path:direction())
print(path:line_interpolate(0.5), path:line_substring(0.25, 0.75), path:line_locate(point(5, 8)))
print(path:offset(2), path:simplify(0.5))
