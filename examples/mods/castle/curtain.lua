--!strict
-- Curtain walls between towers, thicker at the foot, with battlements on the outside.
local masonry = require("@masonry")
local materials = masonry.materials

local Span = module("Span", "from", "to")

-- Returns walls between positions, counter-clockwise around the ward; `height` (m) is the height of the wall walk.
return function(places: { any }, height: number)
  local wall = lsystem({ object = extruder({ smooth = false }) })
  local spans = {}
  for number = 2, #places do
    table.insert(spans, Span(vec(places[number - 1]), vec(places[number])))
  end
  wall:axiom(table.unpack(spans))

  wall:interpret("Span(from, to)", function(this, from, to)
    local span = to - from
    local way = span:unit()
    local middle = (from + to) * 0.5
    local out = vec(way.y, -way.x, 0)
    local function layer(material, thick: number, low: number, high: number)
      this:material(material)
      masonry.block(this, middle + vec(0, 0, low), way, span:length(), thick, high - low)
    end
    layer(materials.footing, 3.1, -2, 1.5)
    layer(materials.dressed, 2.8, 1.5, 1.8)
    layer(materials.ashlar, 2.4, 1.8, height - 0.35)
    layer(materials.dressed, 2.9, height - 0.35, height)
    local edge = out * 1.15 + vec(0, 0, height)
    masonry.battlements.straight(this, from + edge, to + edge)
  end)

  return wall:derive()
end
