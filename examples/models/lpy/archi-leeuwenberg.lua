--!strict
-- Leeuwenberg's model of tree architecture: each axis ends and is continued by a whorl of equal branches.
-- Source: L-Py, tutorial/11 - archimodels/leuwenberg, F. Boudon and C. Godin, after F. Halle, R. Oldeman and
-- P. Tomlinson, Tropical trees and forests, 1978.
local steps = param("steps", { default = 37, min = 0, max = 41, step = 1, doc = "Steps of growth" })
local axes = param("axes", { default = 3, min = 2, max = 5, step = 1, doc = "Branches of a whorl" })
local life =
  param("life", { default = 3, min = 1, max = 10, step = 1, unit = "steps", doc = "Life of leaves" })
local rise =
  param("rise", { default = 7, min = 0, max = 15, unit = "deg", doc = "Bending upwards per internode" })
local THICKENING = 0.02 -- of an internode in a step

local Apex, End = module("Apex", "age", "order"), module("End")
local Internode, Leaves = module("Internode", "width"), module("Leaves", "age", "turn")

local function internodes(order: number): number
  return 10 // (order + 1) + 3
end

local tree = lsystem({ object = turtle({ color = "#7a5a3f", width = 0.2 }), interpret = "last" })
tree:axiom(Apex(0, 0))
tree:rule("Apex(age, order)", function(this, age, order): any
  if age < internodes(order) then
    return if order > 0 then Up(rise) else Up(0),
      Internode(0.2),
      Leaves(0, 90 * (age % 2)),
      Apex(age + 1, order)
  end
  local whorl: any = { End() }
  for k = 1, axes do
    table.insert(whorl, { Roll(360 * k / axes), Pitch(90 - 7.5 * order), Apex(0, order + 1) })
  end
  return table.unpack(whorl)
end)
tree:rule("Internode(width)", function(this, width: number)
  return Internode(width + THICKENING)
end)
tree:rule("Leaves(age, turn)", function(this, age, turn)
  return if age < life then Leaves(age + 1, turn) else nil
end)
tree:interpret("Internode(width)", function(this, width)
  return Width(width), F(1)
end)
local leaf = {
  BeginPolygon(),
  Point(),
  { Turn(25), G(1), Point() },
  { G(2), Point() },
  { Turn(-25), G(1), Point() },
  EndPolygon(),
}
tree:interpret("Leaves(age, turn)", function(this, age, turn)
  return Color(if age < 2 then "#7fb84a" else "#4f8a3a"),
    Roll(turn),
    { Pitch(60), table.unpack(leaf) },
    { Up(60), table.unpack(leaf) }
end)
local result = tree:derive(steps)

-- The axes of the orders 0 to 3 have 13, 8, 6 and 5 internodes, and take one more step to branch: 36 steps. Those of
-- the order 4 have their first internode.
expect(result.counts.Internode, 13 + 8 * 3 + 6 * 3 ^ 2 + 5 * 3 ^ 3 + 3 ^ 4)
expect(result.counts.End, 1 + 3 + 9 + 27)
