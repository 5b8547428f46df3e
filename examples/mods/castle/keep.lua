--!strict
-- A keep: walls with lancets from the templates of masonry, under a steep slate roof.
local masonry = require("@masonry")
local materials = masonry.materials

local Keep = module("Keep", "height")
local Roof = module("Roof")

-- Returns a keep over an outline; `height` is in metres.
return function(outline: { any }, height: number)
  local keep = lsystem({ object = footprint(outline) })
  keep:axiom(Keep(height), Roof())
  local facade = masonry.lancets.facade(2.6)
  keep:interpret("Keep(height)", function(this, height)
    this
      :groundwork("z_min", materials.footing)
      :walls({ height = height, templates = facade, material = materials.ashlar })
  end)
  keep:interpret("Roof()", function(this)
    this:roof({
      kind = "hip",
      slope = 58,
      overhang = 0.5,
      eaves = "closed",
      material = materials.slate,
      trim = materials.dressed,
      gable = materials.ashlar,
    })
  end)
  return keep:derive()
end
