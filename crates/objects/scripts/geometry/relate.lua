-- The relations of a plot, a house inside, the adjacent plot and a path across.
local plot = polygon({ 0, 0 }, { 9, 0 }, { 9, 9 }, { 0, 9 })
local house = polygon({ 2, 2 }, { 6, 2 }, { 6, 6 }, { 2, 6 })
local beside = polygon({ 9, 0 }, { 15, 0 }, { 15, 9 }, { 9, 9 })
local path = line(vec(-2, 4), vec(11, 4))
print(plot:contains(house), house:within(plot), plot:covers(house), plot:equals(house), plot:overlaps(house))
print(plot:touches(beside), plot:disjoint(beside), path:crosses(plot), path:intersects(house))
print(plot:relate(beside), plot:relate(beside, "F***1****"))
