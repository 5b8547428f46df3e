--!strict
-- A cubic B-spline by the algorithm of Lane and Riesenfeld: one step inserts the midpoints of all edges, and the next
-- steps replace the vertices by the midpoints. The number of the step says which rules apply.
-- Source: L-Py, tutorial/03 - subdivision-curves/bspline, F. Boudon and C. Godin.
local rounds = param("rounds", { default = 4, min = 0, max = 6, step = 1, doc = "Rounds of subdivision" })
local degree = param("degree", { default = 3, min = 1, max = 5, step = 1, doc = "Degree of the spline" })

local Vertex = module("Vertex", "place")

local function is_insertion(): boolean
  return step() % degree == if degree == 1 then 0 else 1
end

local curve = lsystem({ object = turtle({ width = 0.05 }), interpret = "last" })
curve:axiom(
  Vertex(vec(0, 0, 0)),
  Vertex(vec(0, 0, 1)),
  Vertex(vec(1, 0, 1)),
  Vertex(vec(1, 0, 0)),
  Vertex(vec(2, 0, 0))
)
curve:rule("Vertex(p) > Vertex(q)", { when = is_insertion }, function(this, p, q)
  return Vertex(p), Vertex((p + q) / 2)
end)
curve:rule("Vertex(p) > Vertex(q)", function(this, p: any, q: any)
  return Vertex((p + q) / 2)
end)
curve:rule("Vertex(p)", {
  when = function()
    return not is_insertion()
  end,
}, function()
  return nil
end)
curve:interpret("Vertex(p) > Vertex(q)", function(this, p, q)
  this:jump(p):color("#c0392b"):sphere(0.025):face(q - p):forward(p:distance(q))
end)
curve:interpret("Vertex(p)", function(this, p)
  this:jump(p):sphere(0.025)
end)
local result = curve:derive(rounds * degree)

-- A round makes 2 v - 1 vertices of v, and two steps of midpoints lose two of them: 5, 7, 11, 19, 35.
expect(result.counts.Vertex, 35)
-- The spline of the first four corners begins at (1 c1 + 4 c2 + 1 c3) / 6 = (1/6, 0, 5/6).
local x, z = result.chains[1]:match("x=([%d.e-]+),y=[%d.e-]+,z=([%d.e-]+)")
expect(tonumber(x), 1 / 6, 0.05)
expect(tonumber(z), 5 / 6, 0.05)
-- Picture: --azimuth 180 --elevation 0
