--!strict
-- Acropetal flow: a hormone rises from the base, one segment per step, into all branches.
-- Source: Virtual Laboratory (cpfg), Signaling/01-hormone-up, University of Calgary.
local steps = param("steps", { default = 3, min = 0, max = 8, step = 1, doc = "Steps of the flow" })

local Empty, Reached = module("Empty"), module("Reached")

local plant = lsystem({ object = turtle({ angle = 45, width = 0.18, sides = 12 }), interpret = "last" })
plant:ignore("Left", "Right")
local chain = { Reached() }
for k = 1, 5 do
  table.insert(chain, { if k % 2 == 1 then Left() else Right(), Empty() })
  table.insert(chain, Empty())
end
plant:axiom(table.unpack(chain))
plant:rule("Reached < Empty", function()
  return Reached()
end)
plant:interpret("Empty", function()
  return Color("#7aa860"), F(1)
end)
plant:interpret("Reached", function()
  return Color("#d8402f"), F(1)
end)
local result = plant:derive(steps)

-- After three steps, four segments of the axis are reached, and the three branches that leave the first three.
expect(result.counts, { Reached = 7, Empty = 4, Left = 3, Right = 2 })
-- Picture: --azimuth 180 --elevation 0
