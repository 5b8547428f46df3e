--!strict
-- The Koch snowflake: the middle third of each edge is replaced by two sides of a triangle.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.1.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the triangle" })
local steps = param("steps", { default = 3, min = 0, max = 7, step = 1, doc = "Steps of the last snowflake" })

for n = 0, steps do
  local place = vec(n % 2, 0, -math.floor(n / 2)) * (size * 1.35)
  local snowflake = abop({
    axiom = "-(30)F--F--F",
    F = "F+F--F+F",
    object = turtle({
      step = size / 3 ^ n,
      angle = 60,
      width = size / 60,
      position = place,
      color = "#1f4e79",
      sides = 4,
    }),
  })

  -- Four edges of a third replace an edge, and the outline returns to its first corner.
  local derived = snowflake:derive(n)
  expect(derived.counts.F, 3 * 4 ^ n)
  expect(derived.objects[1]:position():distance(place), 0, 1e-8)
end

-- Picture: --azimuth 180 --elevation 0
