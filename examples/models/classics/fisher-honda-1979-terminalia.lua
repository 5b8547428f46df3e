--!strict
-- Two tiers of Terminalia catappa: five branches of a tier fork again and again in a horizontal plane, and carry a disc
-- of leaves at each node. The angles of the forks give nearly the greatest leaf area.
-- Source: J. Fisher and H. Honda, Branch geometry and effective leaf area: a study of Terminalia-branching pattern, 1979;
-- numbers from the Virtual Laboratory (cpfg), Open/09-two-tiers.
local steps = param("steps", { default = 5, min = 0, max = 7, step = 1, doc = "Number of forks" })
local major =
  param("major", { default = 0.94, min = 0.5, max = 1, doc = "Length of the first branch by its parent" })
local minor =
  param("minor", { default = 0.87, min = 0.5, max = 1, doc = "Length of the second branch by its parent" })
local bend =
  param("bend", { default = 24.4, min = 0, max = 60, unit = "deg", doc = "Angle of the first branch" })
local fork =
  param("fork", { default = 36.9, min = 0, max = 60, unit = "deg", doc = "Angle of the second branch" })
local DIVERGENCE = 138.5 -- degrees from one branch of a tier to the next

local Apex, Leaves = module("Apex", "length", "side"), module("Leaves")

local tree = lsystem({ object = turtle({ color = "#6b4f36", width = 0.12, sides = 6 }), interpret = "last" })
local function tier(side: number)
  local parts: any = {}
  for k = 1, 5 do
    local hand = if k % 2 == 1 then side else -side
    table.insert(parts, { Roll(k * DIVERGENCE), Turn(90), F(1), Apex(1, hand) })
  end
  return parts
end
tree:axiom(F(1.5), tier(1), F(2.2), tier(-1))
tree:rule("Apex(l, side)", function(this, l: number, side: number)
  return Leaves(),
    { Pitch(-fork * side), F(l * minor), Apex(l * minor, side) },
    Pitch(bend * side),
    F(l * major),
    Apex(l * major, -side)
end)
local function disc(this)
  this:color("#5f9a3f"):begin_polygon()
  for k = 1, 8 do
    this:pitch(45):advance(0.26):point():advance(-0.26)
  end
  this:end_polygon()
end
tree:interpret("Apex", disc)
tree:interpret("Leaves", disc)
local result = tree:derive(steps)

-- Two tiers of five branches, whose number of tips doubles in each step.
expect(result.counts.Apex, 2 * 5 * 2 ^ 5)
expect(result.counts.Leaves, 2 * 5 * (2 ^ 5 - 1))
