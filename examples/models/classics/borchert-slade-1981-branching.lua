--!strict
-- A tree whose forks become rarer with age: the generation n forks with the probability (2n + 1) / n^2, so that the
-- number of shoots grows as the surface of the crown. A shoot that does not fork has a leaf instead.
-- Source: R. Borchert and N. Slade, Bifurcation ratios and the adaptive geometry of trees, 1981; as an L-system in the
-- Virtual Laboratory (cpfg), Quantitative-info-flow/02-Borchert-Slade, and in L-Py, training/10-random-tree.
local generations =
  param("generations", { default = 18, min = 1, max = 30, step = 1, doc = "Generations of shoots" })
local straight =
  param("straight", { default = 20, min = 0, max = 60, unit = "deg", doc = "Angle of the first shoot" })
local lateral =
  param("lateral", { default = 32, min = 0, max = 60, unit = "deg", doc = "Angle of the second shoot" })
local vigour =
  param("vigour", { default = 0.95, min = 0.7, max = 1, doc = "Length of a shoot by its parent" })

local Apex, Shoot = module("Apex", "side", "length"), module("Shoot", "length", "age")
local Leaf = module("Leaf")

local leaf = lsystem({ object = turtle({ color = "#5f9a3f" }) })
leaf:axiom(
  BeginPolygon(),
  Point(),
  { Turn(30), G(0.5), Point() },
  { G(1), Point() },
  { Turn(-30), G(0.5), Point() },
  EndPolygon()
)
local model = leaf:derive(0)

local tree = lsystem({ object = turtle({ color = "#6b4f36", sides = 6, width = 0.5 }), interpret = "last" })
tree:axiom(Shoot(5, 0), Apex(1, 2))
tree:rule("Apex(side, l)", function(this, side: number, l: number): any
  local n, next = step(), l * vigour
  local first = { Turn(-straight * side), Shoot(next, n), Apex(-side, next) }
  if random() < (2 * n + 1) / n ^ 2 then
    return Roll(90), { Turn(lateral * side), Shoot(next, n), Apex(side, next) }, first
  end
  return Roll(90), { Turn(lateral * side), Leaf() }, first
end)
tree:interpret("Shoot(length, age)", function(this, length, age)
  return Width(0.5 / (1 + 0.5 * age)), F(length)
end)
for _, name in { "Leaf", "Apex" } do
  tree:interpret(name, function()
    return Place(model, 1.2)
  end)
end
local result = tree:derive(generations)

-- The generations 1 and 2 always fork. From then on, the expected number grows by (n + 1)^2 / n^2: after n steps there are
-- 4 (n + 1)^2 / 9 shoots, of which only the last generation has an apex.
expect(result.counts.Apex, 4 * 19 ^ 2 / 9, 80)
