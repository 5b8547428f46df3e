-- The result of towers.lua next to this file: { height = 24 }.
local towers = require("towers")
print(towers.height)
