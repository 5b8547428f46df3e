--!strict
-- A generalised cylinder through the points of a Koch curve: each corner is a control point of one smooth tube.
-- Source: Virtual Laboratory (cpfg), CPFG manual, GeneralizedCylinder, University of Calgary.
local steps = param("steps", { default = 2, min = 0, max = 4, step = 1, doc = "Steps of the derivation" })
local width = param("width", { default = 0.8, min = 0.1, max = 1.5, doc = "Diameter, in edges" })
local sides = param("sides", { default = 24, min = 3, max = 64, step = 1, doc = "Faces around the tube" })

local Begin, End, Corner, Edge = module("Begin"), module("End"), module("Corner"), module("Edge")

local tube = lsystem({ object = turtle({ angle = 60, width = width, sides = sides, color = "#b8862f" }) })
-- A triangle whose last side is left open.
tube:axiom("Begin Corner Edge --Corner Edge --Corner End")
tube:rule("Edge", "Edge Corner + Edge Corner -- Edge Corner + Edge")
tube:interpret("Begin", function(this)
  this:begin_cylinder()
end)
-- Only drawing adds a control point, so a corner is the end of its edge.
tube:interpret("Edge", function(this)
  this:forward(1)
end)
tube:interpret("End", function(this)
  this:end_cylinder()
end)
tube:interpret("Corner", function() end)
local result = tube:derive(steps)

-- Two sides of four edges for one in each step; the open side is 3^2 edges long.
expect(result.counts.Edge, 2 * 4 ^ 2)
expect(result.objects[1]:position():length(), 3 ^ 2, 1e-9)
-- Picture: --azimuth 180 --elevation 20
