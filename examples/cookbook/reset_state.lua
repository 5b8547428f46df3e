--!strict
-- A candelabra: a branch gives the state of the turtle back at its end, so an arm changes nothing for the next one.
local Stem, Arm, Candle = module("Stem", "length"), module("Arm"), module("Candle", "height")

local lamp =
  lsystem({ object = turtle({ color = "#b08d4f", metallic = 1, roughness = 0.3, width = 0.07, sides = 16 }) })

local parts: { any } = { { Sphere(0.16) }, Stem(0.9) }
for _ = 1, 6 do
  -- The braces are the branch: position, heading, width and colour are as before at their end.
  table.insert(parts, { Arm(), Candle(0.3) })
  table.insert(parts, Roll(60))
end
table.insert(parts, Stem(0.5))
table.insert(parts, Candle(0.42))
lamp:axiom(sequence(parts))

lamp:interpret("Stem(length)", function(this, length)
  this:forward(length):sphere(0.075)
end)
lamp:interpret("Arm", function(this)
  this:width(0.04):turn(115)
  for _ = 1, 9 do
    this:forward(0.075):turn(-12.8)
  end
end)
lamp:interpret("Candle(height)", function(this, height)
  this:width(0.14):forward(0.03):width(0.06)
  this:material({ color = "#f2ead6" }):forward(0.01):forward(height)
  this
    :material({ color = "#ffb84d", emissive = "#c97a1c" })
    :width(0.05)
    :forward(0.03)
    :width(0.005)
    :forward(0.07)
end)

lamp:derive()
