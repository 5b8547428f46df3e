--!strict
-- A hidden Markov chain: zones of a stem follow one another, and each node bears a leaf, a fruit or nothing by the
-- chances of its zone.
-- Source: L-Py, training/12-hidden-markov-1stem, F. Boudon and C. Godin.
local nodes = param("nodes", { default = 150, min = 1, max = 300, step = 1, doc = "Nodes of a stem" })
local stems = param("stems", { default = 5, min = 1, max = 12, step = 1, doc = "Number of stems" })
local stay = param("stay", { default = 0.95, min = 0, max = 1, doc = "Chance that a node stays in its zone" })

-- The chances of a leaf and of a fruit in the fruiting zone and in the vegetative zone.
local LEAF, FRUIT = { 0.4, 0.3 }, { 0.5, 0.1 }

local Apex, Node = module("Apex", "zone"), module("Node", "zone")
local Internode, Leaf, Fruit = module("Internode", "zone"), module("Leaf"), module("Fruit")

local plants = lsystem({ object = turtle({ width = 4 }), interpret = "last" })
local row = {}
for k = 1, stems do
  table.insert(row, { Turn(-90), G(k * 90), Turn(90), Apex(if random() < 0.5 then 1 else 2) })
end
plants:axiom(table.unpack(row))
plants:rule("Apex(zone)", function(this, zone)
  return Internode(zone),
    { Turn(if step() % 2 == 0 then 60 else -60), Node(zone) },
    Apex(if random() < stay then zone else 3 - zone)
end)
plants:decompose("Node(zone)", function(this, zone): any
  local chance = random()
  if chance < LEAF[zone] then
    return Leaf()
  elseif chance < LEAF[zone] + FRUIT[zone] then
    return Fruit()
  end
  return nil
end)
plants:interpret("Internode(zone)", function(this, zone)
  return Color(if zone == 1 then "#8a5a2f" else "#4d7a3a"), F(2)
end)
plants:interpret("Leaf", function()
  return Color("#5fae48"), Width(2), F(20)
end)
plants:interpret("Fruit", function()
  return Color("#d8402f"), Width(1), F(6), Sphere(3.5)
end)
local result = plants:derive(nodes)

-- In each zone, nodes have these parts with the chances 0.9 and 0.4: of 750 nodes, between 300 and 675 on average.
-- The tolerance is four standard deviations.
expect(result.counts.Internode, 750)
expect(result.counts.Leaf + result.counts.Fruit, 487.5, 187.5 + 54)
-- Picture: --azimuth 180 --elevation 0
