--!strict
-- Cook's model of tree architecture: the trunk grows without rest, and its tiers of branches look and fall like leaves.
-- Source: L-Py, tutorial/11 - archimodels/cook, F. Boudon and C. Godin, after F. Halle, R. Oldeman and P. Tomlinson,
-- Tropical trees and forests, 1978.
local steps = param("steps", { default = 39, min = 0, max = 80, step = 1, doc = "Steps of growth" })
local stage =
  param("stage", { default = 2, min = 1, max = 6, step = 1, unit = "steps", doc = "Steps from tier to tier" })
local axes = param("axes", { default = 6, min = 2, max = 10, step = 1, doc = "Branches of a tier" })
local life =
  param("life", { default = 14, min = 1, max = 40, step = 1, unit = "steps", doc = "Life of a branch" })
local THICKENING = 0.01 -- of an internode in a step

local Trunk, Internode = module("Trunk", "age"), module("Internode", "width")
local Branch, Piece = module("Branch", "age"), module("Piece", "left")

local tree = lsystem({ object = turtle({ color = "#7a5a3f", sides = 6 }), interpret = "last" })
tree:axiom(Trunk(1 - stage))
tree:rule("Trunk(age)", function(this, age: number): any
  local parts: any = { Internode(0.1) }
  if age % stage == 0 then
    for k = 1, axes do
      table.insert(parts, { Roll(360 * k / axes), Branch(0) })
    end
  end
  table.insert(parts, Roll(37))
  table.insert(parts, Trunk(age + 1))
  return table.unpack(parts)
end)
tree:rule("Internode(width)", function(this, width: number)
  return Internode(width + THICKENING)
end)
tree:rule("Branch(age)", function(this, age)
  return if age < life - 1 then Branch(age + 1) else nil
end)
tree:interpret("Internode(width)", function(this, width)
  return Width(width), F(0.5)
end)
-- A branch bends down with age, and has at most five pairs of leaves.
tree:interpret("Branch(age)", function(this, age)
  return Pitch(70 + 2 * age),
    Width(0.06),
    Color(mix("#6fae3f", "#8a7a2f", age / life)),
    Piece(math.min(age, 5))
end)
local function leaf(side: number)
  return {
    Turn(60 * side),
    BeginPolygon(),
    Point(),
    { Turn(25), G(0.4), Point() },
    { G(0.8), Point() },
    { Turn(-25), G(0.4), Point() },
    EndPolygon(),
  }
end
tree:interpret("Piece(left)", function(this, left)
  if left == 0 then
    return F(0.2), leaf(0)
  end
  return F(0.5), leaf(1), leaf(-1), Pitch(3), Piece(left - 1)
end)
local result = tree:derive(steps)

-- An internode in each step; the tiers of the steps 2, 4, ..., 38. Those of step 26 and later are at most 13 old.
expect(result.counts.Internode, 39)
expect(result.counts.Branch, 7 * 6)
