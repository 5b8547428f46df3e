--!strict
-- The interpolating four-point scheme: old vertices stay, and each edge gets a new vertex from its four neighbours.
-- Source: L-Py, tutorial/03 - subdivision-curves/interpolation4, F. Boudon and C. Godin, after N. Dyn, D. Levin and
-- J. Gregory, A 4-point interpolatory subdivision scheme for curve design, 1987.
local steps = param("steps", { default = 4, min = 0, max = 7, step = 1, doc = "Steps of subdivision" })
local tension =
  param("tension", { default = 0.0625, min = 0, max = 0.12, doc = "Weight of the outer neighbours" })

local Vertex = module("Vertex", "place", "is_old")

local curve = lsystem({ object = turtle({ width = 0.05 }), interpret = "last" })
local chain = {}
for k, place in { vec(0, 0, 0), vec(0, 0, 1), vec(1, 0, 1), vec(1, 0, 0), vec(2, 0, 0) } do
  chain[k] = Vertex(place, true)
end
curve:axiom(table.unpack(chain))
-- The vertex between b and c; at the ends of the curve, the end takes the place of the outer neighbour.
local function between(a: any, b: any, c: any, d: any): any
  return Vertex((b + c) * (0.5 + tension) - (a + d) * tension, false)
end
curve:rule("Vertex(a, i) < Vertex(b, j) > Vertex(c, k) Vertex(d, l)", function(this, a, i, b, j, c, k, d)
  return Vertex(b, j), between(a, b, c, d)
end)
curve:rule("Vertex(b, j) > Vertex(c, k) Vertex(d, l)", function(this, b, j, c, k, d)
  return Vertex(b, j), between(b, b, c, d)
end)
curve:rule("Vertex(a, i) < Vertex(b, j) > Vertex(c, k)", function(this, a, i, b, j, c)
  return Vertex(b, j), between(a, b, c, c)
end)
curve:interpret("Vertex(b, j) > Vertex(c, k)", function(this, b, j, c)
  this
    :jump(b)
    :color("#35406f")
    :sphere(if j then 0.06 else 0.03)
    :face(c - b)
    :color("#c0392b")
    :forward(b:distance(c))
end)
curve:interpret("Vertex(b, j)", function(this, b)
  this:jump(b):color("#35406f"):sphere(0.06)
end)
local result = curve:derive(steps)

-- The number of edges doubles, and the five vertices of the polygon stay.
expect(result.counts.Vertex, 4 * 2 ^ 4 + 1)
local _, old = result.chains[1]:gsub("true", "")
expect(old, 5)
-- Picture: --azimuth 180 --elevation 0
