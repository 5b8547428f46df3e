--!strict
-- A spiral stair: the rise of a storey decides about the number of its steps.
local rise = param("rise", { default = 3.2, min = 0.5, max = 6, unit = "m", doc = "Height of the storey" })

local Stair = module("Stair", "rise")
local Step = module("Step", "height")
local Pole = module("Pole", "height")

local stair = lsystem({ object = extruder({ smooth = false }) })

stair:axiom(Stair(rise))

stair:rule("Stair(rise)", function(this, rise: number)
  local count = math.ceil(rise / 0.18)
  local modules: { any } = { { Pole(rise + 1) } }
  for _ = 1, count do
    table.insert(modules, Step(rise / count))
  end
  return sequence(modules)
end)

stair:interpret("Pole(height)", function(this, height)
  this:regular(16):scale(0.09):color("#4a4f54"):extrude(height)
end)
stair:interpret("Step(height)", function(this, height)
  this:advance(height - 0.05):roll(18):color("#c79a62")
  this:polygon({ { 0.08, -0.05 }, { 1.1, -0.22 }, { 1.1, 0.22 }, { 0.08, 0.05 } }):scale(1):extrude(0.05)
end)

stair:derive()
