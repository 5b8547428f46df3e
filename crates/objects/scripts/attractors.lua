-- Branches that grow into a ball of points.
local points = {}
for i = 1, 400 do
  local height, turn = 2 + 2 * random(), random(0, 360)
  local reach = 1.2 * math.sqrt(random())
  points[i] = vec(reach * math.cos(math.rad(turn)), reach * math.sin(math.rad(turn)), height)
end
local space = attractors({ points = points, influence = 1.5, kill = 0.3 })
local Node = module("Node")
local tree = lsystem({ object = turtle({ width = 0.04, color = "#6d5a43" }), environment = space })
tree:axiom(F(1.6), Node())
local Grow = module("Grow", "x", "y", "z")
tree:rule("Node", {
  when = function(this)
    return space:count(this:position()) > 0
  end,
}, function(this)
  local to = space:direction(this:position())
  return Node(), { Grow(to.x, to.y, to.z), Node() }
end)
tree:interpret("Node", function(this)
  space:add(this:position())
end)
tree:interpret("Grow(x, y, z)", function(this, x, y, z)
  this:face(vec(x, y, z)):forward(0.2)
end)
tree:derive(24)
