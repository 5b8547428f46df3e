-- What towers.lua beside this file returns: { height = 24 }.
local towers = require("towers")
print(towers.height)
