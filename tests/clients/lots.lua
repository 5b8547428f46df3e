--!strict
-- Two lots of 500 m² with a street between them, and a well: layers for drawings.
local Lot, Street, Well = module("Lot", "shape"), module("Street", "line"), module("Well", "place")
local lots = lsystem()
lots:axiom(source({ { id = "a", x = 0 }, { id = "b", x = 30 } }), function(feature)
  local x = feature.x
  return Lot(polygon({ { x, 0 }, { x + 20, 0 }, { x + 20, 25 }, { x, 25 } }))
end)
lots:derive()

local streets = lsystem()
streets:axiom(Street(line({ { 25, -5 }, { 25, 30 } })), Well(point({ 5, 5 })))
streets:derive()
