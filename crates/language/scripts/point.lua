-- A well, and its distance from the house.
local well = point(12, 5)
local house = geometry("POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))")
print(well:distance(house))
