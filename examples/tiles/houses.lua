-- Houses of a village with roofs of random heights, one chain for each building of the data.
-- burgeon tiles plan examples/tiles/houses.lua --data examples/data -o out --target-features 10
local Walls, Roof = module("Walls", "height"), module("Roof", "height")

local houses = lsystem({ object = footprint })

houses:axiom(source("village.geojson", { where = "levels > 0" }), function(feature)
  return footprint(feature.geometry), Walls(feature.height)
end)

houses:rule("Walls(height)", function(this, height)
  return Walls(height), Roof(random(1, 3))
end)

houses:interpret("Walls(height)", function(this, height)
  this:walls({ height = height })
end)

houses:interpret("Roof(height)", function(this, height)
  if lod > 2 then
    this:roof({ kind = "hip", height = height })
  end
end)

houses:derive(1)
