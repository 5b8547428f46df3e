--!strict
-- De Casteljau's algorithm: four steps halve the edges of a control polygon until one point is left, which divides the
-- curve into two with their own polygons. Hooks choose between the rules that halve and those that begin anew.
-- Source: L-Py, tutorial/03 - subdivision-curves/decasteljau, F. Boudon and C. Godin.
local divisions =
  param("divisions", { default = 3, min = 0, max = 6, step = 1, doc = "Divisions of a curve" })
local color = param("color", { default = "#c0392b", doc = "Colour of the polygon" })
local DEGREE = 4

-- Edges are active until they belong to a new polygon. A vertex is an end of a curve, fixed, or still free.
local Vertex, Edge, Fixed = module("Vertex", "place", "kind"), module("Edge"), module("Fixed")

local POINTS = { vec(0, 0, 0), vec(0, 0, 1), vec(1, 0, 1), vec(1, 0, 0), vec(2, 0, 0) }

-- The vertex between two others is an end when it is the last one, and fixed at the border of the new polygon.
local function kind_between(left: string, right: string): string
  if left == "fixed" and right == "fixed" then
    return "end"
  end
  return if left == "free" and right == "free" then "free" else "fixed"
end

local polygon_of = lsystem({ object = turtle({ width = 0.03 }), interpret = "last" })
local chain: { any } = {}
for k, place in POINTS do
  table.insert(chain, Vertex(place, if k == 1 or k == #POINTS then "end" else "free"))
  if k < #POINTS then
    table.insert(chain, Edge())
  end
end
polygon_of:axiom(sequence(chain))
polygon_of:before_step(function(now)
  use_group(if now.step % (DEGREE + 1) == 0 then "begin" else "halve")
end)
polygon_of:rule("Vertex(p, a) < Edge > Vertex(q, b)", { group = "halve" }, function(this, p, a, q, b)
  return Vertex(lerp(p, q, 0.5), kind_between(a, b))
end)
polygon_of:rule("Edge < Vertex(p, kind) > Edge", { group = "halve" }, function(this, p, kind)
  if kind == "free" then
    return Edge()
  end
  return Fixed(), Vertex(p, kind), Fixed()
end)
polygon_of:rule("Edge < Vertex(p, kind)", { group = "halve" }, function(this, p, kind)
  return Fixed(), Vertex(p, kind)
end)
polygon_of:rule("Vertex(p, kind) > Edge", { group = "halve" }, function(this, p, kind)
  return Vertex(p, kind), Fixed()
end)
polygon_of:rule("Fixed", { group = "begin" }, function()
  return Edge()
end)
polygon_of:rule('Vertex(p, "fixed")', { group = "begin" }, function(this, p)
  return Vertex(p, "free")
end)
polygon_of:interpret("Vertex(p, a) < Edge > Vertex(q, b)", function(this, p, a, q)
  this:jump(p):face(q - p):color(color):forward(p:distance(q))
end)
polygon_of:interpret("Vertex(p, kind)", function(this, p, kind)
  this:jump(p):color(if kind == "end" then "#35406f" else "#9aa3c0"):sphere(0.03)
end)
local result = polygon_of:derive(divisions * (DEGREE + 1))

-- Each polygon has four edges, and each division doubles the polygons.
expect(result.counts, { Edge = 4 * 2 ^ 3, Vertex = 4 * 2 ^ 3 + 1 })
-- The ends are on the Bezier curve of the five points: here at a half of its parameter.
local half = vec(0, 0, 0)
for k, weight in { 1, 4, 6, 4, 1 } do
  half += POINTS[k] * (weight / 16)
end
local middle = `Vertex(vec\{x={half.x},y=0,z={half.z}},"end")`
expect(string.find(result.chains[1], middle, 1, true) ~= nil, true)
-- Picture: --azimuth 180 --elevation 0
