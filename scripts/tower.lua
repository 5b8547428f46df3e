--!strict
-- A twisted, tapering tower of extruded blocks: each storey is a ring of smaller blocks around a core.
local floors = param("floors", { default = 24, min = 1, max = 120, step = 1 })
local twist = param("twist", { default = 4, min = -15, max = 15, unit = "deg" })

local Floor = module("Floor", "n", "radius")
local Slab = module("Slab", "height", "radius")
local Cap = module("Cap", "radius")

local tower = lsystem({ object = extruder({ sides = 8, smooth = false }) })

tower:axiom(Floor(floors, 6))

tower:rule("Floor(n, r)", function(this, n, r)
  if n == 0 then
    return Cap(r)
  end
  return Slab(3, r), Floor(n - 1, r * 0.97)
end)

tower:interpret("Slab(h, r)", function(this, h, r)
  this:scale(r):roll(twist):extrude(h)
end)

tower:derive(floors + 1)
