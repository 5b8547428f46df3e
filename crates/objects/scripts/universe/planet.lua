-- The first planet of the first star of a galaxy.
local all = universe({ seed = 7 })
local galaxy = all:galaxy(0, 0, 0)
local star = all:star(galaxy, 1)
local found = if star.planets > 0 then all:planet(star, 1) else nil
print(found and found.kind, found and found.radius)
