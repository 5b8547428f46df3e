--!strict
-- Massart's model of tree architecture: the trunk grows rhythmically and bears tiers of horizontal branches.
-- Source: L-Py, tutorial/11 - archimodels/massart, F. Boudon and C. Godin, after F. Halle, R. Oldeman and
-- P. Tomlinson, Tropical trees and forests, 1978.
local tiers = param("tiers", { default = 7, min = 1, max = 12, step = 1, doc = "Number of tiers" })
local stage =
  param("stage", { default = 4, min = 1, max = 8, step = 1, unit = "steps", doc = "Steps from tier to tier" })
local axes = param("axes", { default = 5, min = 2, max = 8, step = 1, doc = "Branches of a tier" })
local life =
  param("life", { default = 12, min = 1, max = 30, step = 1, unit = "steps", doc = "Life of leaves" })
local THICKENING = 0.01 -- of an internode in a step

local Trunk, Branch = module("Trunk", "age"), module("Branch")
local Internode, Leaves = module("Internode", "length", "width"), module("Leaves", "age")

local tree = lsystem({ object = turtle({ color = "#7a5a3f", sides = 6 }), interpret = "last" })
tree:axiom(Trunk(1 - stage))
tree:rule("Trunk(age)", function(this, age: number): any
  local parts: any = { Internode(1, 0.2), Roll(90) }
  if age % stage == 0 then
    local angle = 30 + 60 * (tiers - age / stage) / tiers
    for k = 1, axes do
      table.insert(parts, { Roll(360 * k / axes), Pitch(angle), Branch() })
    end
  end
  table.insert(parts, Trunk(age + 1))
  return table.unpack(parts)
end)
tree:rule("Branch", function()
  return Internode(0.5, 0.1), Leaves(0), Branch()
end)
tree:rule("Internode(length, width)", function(this, length: number, width: number)
  return Internode(length, width + THICKENING)
end)
tree:rule("Leaves(age)", function(this, age)
  return if age < life then Leaves(age + 1) else nil
end)
tree:interpret("Internode(length, width)", function(this, length, width)
  return Width(width), F(length)
end)
local function leaf(side: number, size: number)
  local turn = side * random(75, 105)
  return {
    Turn(turn),
    Pitch(random(-10, 20)),
    BeginPolygon(),
    Point(),
    { Turn(25), G(size / 2), Point() },
    { G(size), Point() },
    { Turn(-25), G(size / 2), Point() },
    EndPolygon(),
  }
end
tree:interpret("Leaves(age)", function(this, age)
  local size = 0.5 + 0.5 * math.min(age / 6, 1)
  return Color(mix("#8fc04f", "#3f7a35", age / life)), leaf(1, size), leaf(-1, size)
end)
local result = tree:derive(tiers * stage)

-- The trunk has an internode for each of 28 steps. The branches of the seven tiers have 24, 20, ..., 4 and 0 of them.
expect(result.counts.Branch, 7 * 5)
expect(result.counts.Internode, 28 + 5 * (24 + 20 + 16 + 12 + 8 + 4))
