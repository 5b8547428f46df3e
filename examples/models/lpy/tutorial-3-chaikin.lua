--!strict
-- Chaikin's corner cutting: each edge keeps its middle half, which gives a quadratic B-spline.
-- Source: L-Py, tutorial/03 - subdivision-curves/chaikin, F. Boudon and C. Godin.
local steps = param("steps", { default = 3, min = 0, max = 7, step = 1, doc = "How often corners are cut" })
local color = param("color", { default = "#c0392b", doc = "Colour of the curve" })

local Vertex, Edge = module("Vertex", "place"), module("Edge")

local curve = lsystem({ object = turtle({ width = 0.04 }), interpret = "last" })
curve:axiom(
  Vertex(vec(0, 0, 0)),
  Edge(),
  Vertex(vec(0, 0, 1)),
  Edge(),
  Vertex(vec(1, 0, 1)),
  Edge(),
  Vertex(vec(1, 0, 0)),
  Edge(),
  Vertex(vec(2, 0, 0))
)
curve:rule("Vertex(p) < Edge > Vertex(q)", function(this, p, q)
  return Vertex(lerp(p, q, 0.25)), Edge(), Vertex(lerp(p, q, 0.75))
end)
curve:rule("Edge < Vertex(p) > Edge", function()
  return Edge()
end)
-- The ends of the curve stay.
curve:rule("Edge < Vertex(p)", function(this, p)
  return Edge(), Vertex(p)
end)
curve:rule("Vertex(p) > Edge", function(this, p)
  return Vertex(p), Edge()
end)
curve:interpret("Vertex(p) < Edge > Vertex(q)", function(this, p, q)
  this:jump(p):face(q - p):color(color):forward(p:distance(q))
end)
curve:interpret("Vertex(p)", function(this, p)
  this:jump(p):color("#35406f"):sphere(0.035)
end)
local result = curve:derive(steps)

-- The number of edges satisfies e(n + 1) = 2 e(n) + 1, from 4.
expect(result.counts, { Edge = 39, Vertex = 40 })
-- Picture: --azimuth 180 --elevation 0
