local all = universe({ seed = 7 })
local galaxy = all:galaxy(0, 0, 0)
local star = all:star(galaxy, 1)
print(galaxy.kind, star.kind, star.planets)
