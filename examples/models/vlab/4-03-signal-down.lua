--!strict
-- Basipetal signal: a pulse moves from the tip to the base, one segment per step, and passes the branches.
-- Source: Virtual Laboratory (cpfg), Signaling/03-signal-down, University of Calgary.
local steps = param("steps", { default = 3, min = 0, max = 8, step = 1, doc = "Steps of the pulse" })

local Empty, Signal = module("Empty"), module("Signal")

local plant = lsystem({ object = turtle({ angle = 45, width = 0.18, sides = 12 }), interpret = "last" })
plant:ignore("Left", "Right")
local chain: any = {}
for k = 1, 5 do
  table.insert(chain, Empty())
  table.insert(chain, { if k % 2 == 1 then Left() else Right(), Empty() })
end
table.insert(chain, Signal())
plant:axiom(table.unpack(chain))
plant:rule("Empty > Signal", function()
  return Signal()
end)
plant:rule("Signal", function()
  return Empty()
end)
plant:interpret("Empty", function()
  return Color("#7aa860"), F(1)
end)
plant:interpret("Signal", function()
  return Color("#d8402f"), F(1)
end)
local result = plant:derive(steps)

-- The pulse stays one segment long. Three steps after the start it is in the third of the six segments.
expect(result.counts, { Signal = 1, Empty = 10, Left = 3, Right = 2 })
expect(
  result.chains[1],
  "Empty [ Left Empty ] Empty [ Right Empty ] Signal [ Left Empty ] Empty [ Right Empty ] Empty [ Left Empty ] Empty"
)
-- Picture: --azimuth 180 --elevation 0
