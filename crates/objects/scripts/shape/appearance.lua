-- A round column, and a wall with tiles of about half a metre.
local column = cylinder(0.3, 3, 24):smooth():material({ roughness = 0.4, color = "ivory" })
local wall = rectangle(5, 3):project("~0.5", 0.5, { angle = 45, offset = { 0.5, 0 } })
print(wall:color("ivory"):face_color(), wall:face_color())
print(column:is_solid(), wall:area())

-- The image shows two windows side by side: half a tile each.
local windows = rectangle(8, 3):project(4, 3):split("u", { "0.5*" })
print(#windows, windows[1]:size())

-- Dirt lies over the whole wall by a set of its own, and its parts keep it.
local stained = wall:project(5, 3, { set = "stain" })
print(#stained:split("x", { "~1*" }))
