--!strict
-- The Sierpinski gasket as one curve, by edge rewriting with two kinds of edges.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.10b.
local steps = param("steps", { default = 6, min = 0, max = 9, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the triangle" })

local LeftEdge, RightEdge = module("LeftEdge"), module("RightEdge")
local pen = turtle({ step = size / 2 ^ steps, angle = 60, width = size / 120, color = "#1f4e79", sides = 4 })
local gasket = lsystem({ object = pen, interpret = "last" })
-- The first turn puts the triangle on its base.
gasket:axiom(Right(if steps % 2 == 0 then 90 else 150), RightEdge())
gasket:rule("LeftEdge", function()
  return RightEdge(), Left(), LeftEdge(), Left(), RightEdge()
end)
gasket:rule("RightEdge", function()
  return LeftEdge(), Right(), RightEdge(), Right(), LeftEdge()
end)
local function draw(this)
  this:forward()
end
gasket:interpret("LeftEdge", draw)
gasket:interpret("RightEdge", draw)

local derived = gasket:derive(steps)
-- Three edges of half the length replace an edge and end where it ended.
expect(derived.counts.LeftEdge + derived.counts.RightEdge, 3 ^ 6)
expect(derived.objects[1]:position():length(), 10, 1e-9)

-- Picture: --azimuth 180 --elevation 0
