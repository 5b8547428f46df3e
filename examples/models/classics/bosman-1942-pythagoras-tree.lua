--!strict
-- The Pythagoras tree: each square carries the squares of the legs of a right triangle.
-- Source: A. Bosman, Het wondere onderzoekingsveld der vlakke meetkunde, 1957; drawn by him in 1942.
local steps = param("steps", { default = 9, min = 0, max = 11, step = 1, doc = "Generations of squares" })
local angle =
  param("angle", { default = 40, min = 20, max = 70, unit = "deg", doc = "Angle of the left square" })

local Square, Bud = module("Square", "side", "n"), module("Bud", "side", "n")

local tree = lsystem({ object = turtle({}), interpret = "last" })
tree:axiom(Square(1, 0), Bud(1, 0))
-- The turtle walks along the left edge of a square, and then along the legs of the triangle.
tree:rule("Bud(s, n)", function(this, s: number, n: number)
  local left, right = s * math.cos(math.rad(angle)), s * math.sin(math.rad(angle))
  return G(s),
    Turn(angle),
    { Square(left, n + 1), Bud(left, n + 1) },
    Turn(-90),
    G(left),
    Turn(90 - 90),
    { Square(right, n + 1), Bud(right, n + 1) }
end)
tree:interpret("Square(s, n)", function(this, s, n)
  this:color(mix("#7a4a2f", "#6fae3f", n / steps)):begin_polygon():point()
  for _ = 1, 3 do
    this:advance(s):point():turn(-90)
  end
  this:advance(s):turn(-90):end_polygon()
end)
local result = tree:derive(steps)

-- 2^n squares in generation n. The area of each generation is that of the first square.
expect(result.counts.Square, 2 ^ 10 - 1)
local area = 0
for side in result.chains[1]:gmatch("Bud%(([%d.e-]+)") do
  area += (tonumber(side) :: number) ^ 2
end
expect(area, 1, 1e-3)
-- Picture: --azimuth 180 --elevation 0
