--!strict
-- A Koch curve that resembles a row of trees: an edge becomes four edges of different lengths, the middle ones later
-- than the last, and the first later still.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.37b.
local steps = param("steps", { default = 12, min = 0, max = 14, step = 1, doc = "Steps of the derivation" })
local angle =
  param("angle", { default = 86, min = 80, max = 90, unit = "deg", doc = "Between tree and ground" })
local p = param("p", { default = 0.3, min = 0.1, max = 0.9, doc = "Place of the tallest tree" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Length of the first edge" })

local q = 1 - p
local h = math.sqrt(p * q) -- height of the right-angled triangle over p and q
local Edge = module("Edge", "length", "delay")

local row = lsystem({
  object = turtle({ angle = angle, width = 0.03, color = "#3d6b35", sides = 4 }),
  interpret = "last",
})
row:axiom(Right(90), Edge(size, 0))
row:rule("Edge(x, delay)", function(this, x: number, delay: number)
  if delay > 0 then
    return Edge(x, delay - 1)
  end
  return Edge(x * p, 2), Left(), Edge(x * h, 1), Right(2 * angle), Edge(x * h, 1), Left(), Edge(x * q, 0)
end)
row:interpret("Edge(x, delay)", function(this, x)
  this:forward(x)
end)

-- An edge without delay becomes one with delay 2, two with delay 1 and one without: e(n) = e(n - 1) + 2 e(n - 2) +
-- e(n - 3) with e(0) = e(-1) = e(-2) = 1, that is 4, 7, 16, 34, 73, 157, 337, 724, 1555, 3340, 7174, 15409.
expect(row:derive(steps).counts.Edge, 15409)

-- Picture: --azimuth 180 --elevation 0
