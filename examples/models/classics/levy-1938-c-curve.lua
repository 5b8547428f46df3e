--!strict
-- The C curve: each edge becomes the legs of a right isosceles triangle.
-- Source: P. Levy, Les courbes planes ou gauches et les surfaces composees de parties semblables au tout, 1938.
local steps = param("steps", { default = 10, min = 0, max = 13, step = 1, doc = "Steps" })
local low = param("low", { default = "#3f3f8f", doc = "Colour at the beginning" })
local high = param("high", { default = "#d8702f", doc = "Colour at the end" })

local Edge = module("Edge", "index")

local curve = lsystem({
  object = turtle({ angle = 45, width = 0.55, heading = { 1, 0, 0 }, sides = 5 }),
  interpret = "last",
})
curve:axiom(Edge(0))
curve:rule("Edge(k)", function(this, k: number)
  return Left(), Edge(2 * k), Right(90), Edge(2 * k + 1), Left()
end)
curve:interpret("Edge(k)", function(this, k)
  return Color(mix(low, high, k / 2 ^ steps)), F(1)
end)
local result = curve:derive(steps)

-- The number of edges doubles; the distance of the ends grows by sqrt(2), in the same direction.
expect(result.counts.Edge, 2 ^ 10)
expect(result.objects[1]:position():distance(vec(32, 0, 0)), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
