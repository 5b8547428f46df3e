--!strict
-- Nozeran's model of tree architecture: the trunk is a sympodium. Each of its modules ends in a tier of branches, and
-- the next module begins below the tier.
-- Source: L-Py, tutorial/11 - archimodels/nozeran, F. Boudon and C. Godin, after F. Halle, R. Oldeman and
-- P. Tomlinson, Tropical trees and forests, 1978.
local modules = param("modules", { default = 4, min = 1, max = 7, step = 1, doc = "Modules of the trunk" })
local stage =
  param("stage", { default = 4, min = 2, max = 8, step = 1, doc = "Internodes below the next module" })
local axes = param("axes", { default = 5, min = 2, max = 8, step = 1, doc = "Branches of a tier" })
local THICKENING = 0.01 -- of an internode in a step

local Trunk, Branch = module("Trunk", "age", "number"), module("Branch", "age")
local Internode, Leaves = module("Internode", "length", "width"), module("Leaves", "age")

local tree = lsystem({ object = turtle({ color = "#7a5a3f", sides = 6 }), interpret = "last" })
tree:axiom(Trunk(1, 1))
tree:rule("Trunk(age, number)", function(this, age, number): any
  local parts: any = { Internode(1, 0.2) }
  if age > stage then
    for k = 1, axes do
      table.insert(parts, { Roll(360 * k / axes), Pitch(80 - 5 * number), Branch(0) })
    end
    return table.unpack(parts)
  elseif age == stage and number < modules then
    local side = if number % 2 == 1 then 45 else -45
    table.insert(parts, { Turn(side), Internode(1, 0.2), Turn(-side), Trunk(1, number + 1) })
  end
  table.insert(parts, Trunk(age + 1, number))
  return table.unpack(parts)
end)
tree:rule("Branch(age)", function(this, age: number)
  return Pitch(0.5),
    Internode(0.3 + 0.3 / (1 + age), 0.1),
    if age % 2 == 0 then Leaves(0) else Leaves(3),
    Branch(age + 1)
end)
tree:rule("Internode(length, width)", function(this, length: number, width: number)
  return Internode(length, width + THICKENING)
end)
tree:rule("Leaves(age)", function(this, age: number)
  return Leaves(age + 1)
end)
tree:interpret("Internode(length, width)", function(this, length, width)
  return Width(width), F(length)
end)
local function leaf(side: number)
  return {
    Turn(side * random(75, 105)),
    Pitch(random(10, 40)),
    BeginPolygon(),
    Point(),
    { Turn(25), G(0.4), Point() },
    { G(0.8), Point() },
    { Turn(-25), G(0.4), Point() },
    EndPolygon(),
  }
end
tree:interpret("Leaves(age)", function(this, age)
  return Color(mix("#8fc04f", "#3f7a35", age / 20)), leaf(1), leaf(-1)
end)
local result = tree:derive((modules + 1) * stage)

-- A module takes five steps, and the next one begins in the fourth: tiers in the steps 5, 9, 13 and 17. Until step 20,
-- their branches have 15, 11, 7 and 3 internodes. The trunk has 5 of them per module, and 3 below the later modules.
expect(result.counts.Branch, 4 * 5)
expect(result.counts.Internode, 4 * 5 + 3 + 5 * (15 + 11 + 7 + 3))
