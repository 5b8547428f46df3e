--!strict
-- A pineapple: at a divergence angle of 138.139542 degrees, each scale touches those 5, 8 and 13 scales older, so the
-- scales are hexagons. The cylinder closes at its top, below a tuft of leaves.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, section 4.2 and figure 4.11.
local scales = param("scales", { default = 90, min = 20, max = 400, step = 1, doc = "Number of scales" })
local radius = param("radius", { default = 0.06, min = 0.01, max = 1, unit = "m", doc = "Of the fruit" })
local DIVERGENCE = 138.139542

-- On the unrolled cylinder, in circumferences: scale n is aside by its angle and above by n rises.
local function aside(n: number): number
  local turn = n * DIVERGENCE / 360
  return turn - math.round(turn)
end
local rise = math.sqrt((aside(5) ^ 2 - aside(8) ^ 2) / (8 ^ 2 - 5 ^ 2)) -- as far to scale 5 as to scale 8
local function distance(n: number): number
  return math.sqrt(aside(n) ^ 2 + (n * rise) ^ 2)
end
-- The angle of the book makes the third distance equal to the other two.
expect(distance(13), distance(5), 1e-5)

local girth = 2 * math.pi * radius
local Apex, Scale, Leaf = module("Apex", "n"), module("Scale", "size"), module("Leaf", "length")
local fruit = lsystem({ object = turtle({ color = "#b07a2a", sides = 6 }), interpret = "last" })
fruit:axiom(Apex(1))
fruit:rule("Apex(n)", function(this, n: number): any
  if n > scales + 34 then
    return nil
  elseif n > scales then
    return { Down(82 - (n - scales) * 2.2), Leaf(0.13) }, RollRight(137.5), Apex(n + 1)
  end
  -- Narrower at both ends.
  local t = 2 * n / scales - 1
  local wide = math.sqrt(1 - 0.75 * t ^ 4)
  return G(rise * girth),
    { Down(90), G(radius * wide), Scale(distance(5) * girth * wide) },
    RollRight(DIVERGENCE),
    Apex(n + 1)
end)
fruit:interpret("Scale(size)", function(this, size: number)
  this:color("#c08a34"):sphere(size * 0.62)
  this:color("#6f7a2e"):advance(size * 0.45)
  this:sphere(size * 0.2)
end)
fruit:interpret("Leaf(length)", function(this, length: number)
  this:color("#4f7f45")
  return BeginPolygon(),
    { Left(90), G(0.009), Point() },
    { G(length), Point() },
    { Right(90), G(0.009), Point() },
    EndPolygon()
end)

expect(fruit:derive(scales + 35).counts.Scale, 90)

-- Picture: --azimuth 180 --elevation 10
