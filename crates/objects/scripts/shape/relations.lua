-- Relations of two houses and a tree.
local house, shed = cuboid(10, 8, 6), cuboid(4, 4, 3):translate(vec(10, 2, 0))
print(house:overlaps(shed), house:touches(shed), house:contains(vec(5, 4, 2)), house:contains(shed))
print(house:distance(vec(5, -3, 1)), house:distance(shed:translate(vec(2, 0, 0))))
