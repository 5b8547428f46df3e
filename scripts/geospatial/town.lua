--!strict
-- The whole quarter: pavements, buildings with facades towards the streets, lawns, trees, a garden and furniture.
-- burgeon run scripts/geospatial/town.lua --data examples/data -o quarter.glb
require("pavements")
require("facades")
require("vegetation")
require("garden")
require("furniture")
require("orientation")
