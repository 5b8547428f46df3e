--!strict
-- A twisted tower. Change a number, save, and watch the live view.
local floors = param("floors", { default = 30, min = 1, max = 120, step = 1 })
local twist = param("twist", { default = 3, min = -15, max = 15, unit = "deg" })
local sides = param("sides", { default = 6, min = 3, max = 24, step = 1 })

-- A module is a symbol with values.
local Floor = module("Floor", "left", "radius")
local Storey = module("Storey", "radius")
local Roof = module("Roof", "radius")

local tower = lsystem({ object = extruder({ sides = sides, smooth = false }) })

tower:axiom(Floor(floors, 9))

-- In each step, the floor becomes a storey and the next floor, and the last floor becomes the roof.
tower:rule("Floor(left, radius)", function(this, left: number, radius: number)
  if left == 0 then
    return Roof(radius)
  end
  return Storey(radius), Floor(left - 1, radius * 0.985)
end)

-- An interpretation draws a module with the extruder. A storey is a slab, and glass that stands back.
tower:interpret("Storey(radius)", function(this, radius)
  this:roll(twist)
  this:material({ color = "#ece7dc" }):scale(radius):extrude(0.5)
  this:material({ color = "#5d7f92", roughness = 0.15 }):scale(radius * 0.93):extrude(2.9)
end)

tower:interpret("Roof(radius)", function(this, radius)
  this:material({ color = "#ece7dc" }):scale(radius):extrude(1.2)
  this:material({ color = "#8a9096", metallic = 1 }):scale(0.35):taper(0.05):extrude(radius * 1.5)
end)

tower:derive()
