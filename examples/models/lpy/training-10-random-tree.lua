--!strict
-- A random tree: at its node k, an axis branches with the probability (2k + 1) / k^2, and otherwise bears a leaf.
-- Source: L-Py, training/10-random-tree, F. Boudon and C. Godin.
local nodes =
  param("nodes", { default = 14, min = 1, max = 24, step = 1, doc = "Nodes from the ground to a tip" })
local branching = param("branching", { default = 32, min = 0, max = 80, unit = "deg", doc = "Of a branch" })
local deviation = param("deviation", { default = 20, min = 0, max = 60, unit = "deg", doc = "Of its axis" })

local Axis, Segment = module("Axis", "node"), module("Segment", "node")
local Leaf, Tip = module("Leaf"), module("Tip")

local blade = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-0.45, 0, 0.3), vec(0, 0.1, 0.3), vec(0.45, 0, 0.3) },
  { vec(-0.3, 0, 0.8), vec(0, 0.1, 0.8), vec(0.3, 0, 0.8) },
  { vec(0, 0.2, 1), vec(0, 0.2, 1), vec(0, 0.2, 1) },
}, { kind = "b-spline", degree = 2, divisions = 2 })

local tree = lsystem({ object = turtle({ width = 0.6, color = "#7a5c40", sides = 6 }), interpret = "last" })
tree:axiom(Axis(1))
tree:rule("Axis(node)", function(this, node: number): any
  if node == nodes then
    return Tip()
  elseif random() < math.min(1, (2 * node + 1) / node ^ 2) then
    return Segment(node), Roll(90), { Turn(branching), Axis(node + 1) }, Turn(-deviation), Axis(node + 1)
  end
  return Segment(node), Roll(90), { Turn(branching), Leaf() }, Turn(-deviation), Axis(node + 1)
end)
tree:interpret("Segment(node)", function(this, node)
  this:width(0.1 + 0.5 / node):forward(1)
end)
tree:interpret("Leaf", function(this)
  this:color("#75a03f"):surface(blade, 1.1)
end)
tree:interpret("Tip", function(this)
  this:color("#75a03f"):surface(blade, 0.9)
end)
local result = tree:derive()

-- The axes grow on average by the factor ((k + 1) / k)^2 from node k on, after two nodes that always branch.
expect(result.counts.Tip, 2 * 2 * (14 / 3) ^ 2, 40)
-- All axes end after the same number of nodes.
expect(result.steps, 14)
-- Picture: --azimuth 180 --elevation 4
