--!strict
-- A Markov chain along a stem: a node with a branch tends to follow a node with a branch, and an empty one an empty.
-- Source: L-Py, training/11a-markov-1stem, F. Boudon and C. Godin.
local nodes = param("nodes", { default = 100, min = 1, max = 200, step = 1, doc = "Nodes of a stem" })
local stems = param("stems", { default = 9, min = 1, max = 12, step = 1, doc = "Number of stems" })
local keep = param("keep", { default = 0.75, min = 0, max = 1, doc = "Chance of a branch after a branch" })
local rest = param("rest", { default = 0.75, min = 0, max = 1, doc = "Chance of no branch after no branch" })

local Apex, Internode = module("Apex", "branched"), module("Internode")
local Shoot = module("Shoot", "side")

local plants = lsystem({ object = turtle({ width = 2, color = "#6f8f3f" }), interpret = "last" })
local row = {}
for k = 1, stems do
  table.insert(row, { Turn(-90), G(k * 60), Turn(90), Apex(random() < 0.5) })
end
plants:axiom(table.unpack(row))
plants:rule("Apex(branched)", function(this, branched)
  local next = if branched then random() < keep else random() >= rest
  if branched then
    return Internode(), { Shoot(if step() % 2 == 0 then 45 else -45) }, Apex(next)
  end
  return Internode(), Apex(next)
end)
plants:interpret("Internode", function()
  return F(2)
end)
plants:interpret("Shoot(side)", function(this, side)
  return Color("#c0562f"), Turn(side), F(16)
end)
local result = plants:derive(nodes)

-- The stationary distribution has (1 - rest) / (2 - keep - rest) branched nodes: one half, of 900. Nodes are correlated
-- by keep + rest - 1 = 1/2, so the standard deviation is 15 * sqrt(3); the tolerance is three times as much.
expect(result.counts.Internode, 900)
expect(result.counts.Shoot, 450, 78)
-- Picture: --azimuth 180 --elevation 0
