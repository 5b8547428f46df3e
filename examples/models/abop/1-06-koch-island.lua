--!strict
-- The quadratic Koch island, in its first four stages: each edge becomes eight edges of a quarter of its length.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.6.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the first square" })
local stages = param("stages", { default = 4, min = 1, max = 5, step = 1, doc = "Stages, two in a row" })

local function island(n: number, place: any): any
  local edge =
    turtle({ step = size / 4 ^ n, width = size / 80, position = place, color = "#1f4e79", sides = 4 })
  return abop({ axiom = "F-F-F-F-", F = "F-F+F+FF-F-F+F", object = edge }):derive(n)
end

for n = 0, stages - 1 do
  local place = vec(n % 2, 0, -math.floor(n / 2)) * (size * 1.8)
  local derived = island(n, place)
  -- Each step replaces an edge by 8, and the outline returns to its first corner.
  expect(derived.counts.F, 4 * 8 ^ n)
  expect(derived.objects[1]:position():distance(place), 0, 1e-9 * size)
end

-- Picture: --azimuth 180 --elevation 0
