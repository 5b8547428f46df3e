--!strict
-- A column: a loop makes the list of its modules, and an interpretation draws each of them.
local Plinth = module("Plinth", "width", "height")
local Drum = module("Drum", "radius")
local Ring = module("Ring", "radius", "height")

local column = lsystem({ object = extruder({ sides = 32, color = "#e3d8c3" }) })

local parts = { Plinth(1.5, 0.25), Ring(0.68, 0.18), Ring(0.6, 0.14) }
for number = 0, 9 do
  table.insert(parts, Drum(0.5 - 0.009 * number))
end
table.insert(parts, Ring(0.5, 0.1))
table.insert(parts, Ring(0.62, 0.22))
table.insert(parts, Plinth(1.4, 0.25))

column:axiom(sequence(parts))

column:interpret("Plinth(width, height)", function(this, width, height)
  this:scale(1):rectangle(width, width):extrude(height)
end)

-- A drum with flutes: a star of 20 points whose inner corners are almost as far out as the points.
column:interpret("Drum(radius)", function(this, radius)
  this:star(20, 0.9):scale(radius):taper(radius - 0.009):extrude(0.42)
end)

-- Half of the ring swells, the other half shrinks.
column:interpret("Ring(radius, height)", function(this, radius, height)
  this:regular(32):scale(radius * 0.9):taper(radius):extrude(height / 2)
  this:taper(radius * 0.88):extrude(height / 2)
end)

column:derive()
