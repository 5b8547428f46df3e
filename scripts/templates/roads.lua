--!strict
-- Street networks: patterns of streets, districts that combine patterns, highways that join centres, and roads from a
-- word of characters.
--
--   local roads = require("templates/roads")
--   roads.grow({ pattern = roads.organic(), extent = 500 })
local growth = require("roads/growth")
local patterns = require("roads/patterns")
local words = require("roads/words")

return {
  organic = patterns.organic,
  raster = patterns.raster,
  radial = patterns.radial,
  contours = patterns.contours,
  populous = patterns.populous,
  districts = patterns.districts,
  system = growth.system,
  grow = growth.grow,
  word = words.word,
}
