--!strict
-- A tree after Honda: each branch forks into two, in the plane through the branch that is as level as possible.
-- Source: H. Honda, Description of the form of trees by the parameters of the tree-like body, 1971.
local steps = param("steps", { default = 9, min = 0, max = 11, step = 1, doc = "Number of forks" })
local first =
  param("first", { default = 0.88, min = 0.5, max = 1, doc = "Length of the first branch by its parent" })
local second =
  param("second", { default = 0.8, min = 0.4, max = 1, doc = "Length of the second branch by its parent" })
local angle =
  param("angle", { default = 28, min = 0, max = 60, unit = "deg", doc = "Angle of the first branch" })
local fork =
  param("fork", { default = 42, min = 0, max = 90, unit = "deg", doc = "Angle of the second branch" })
local THINNER = 0.707 -- the cross-sections of two branches add up to that of their parent

local Apex = module("Apex", "length", "width")

local tree = lsystem({ object = turtle({ color = "#6b4a32", width = 0.22, sides = 5 }), interpret = "last" })
tree:axiom(Roll(30), Pitch(3), Apex(1, 0.22))
tree:rule("Apex(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Level(), Turn(angle), Apex(l * first, w * THINNER) },
    { Level(), Turn(-fork), Apex(l * second, w * THINNER) }
end)
tree:interpret("Apex(l, w)", function(this, l)
  return Color("#6f9a3a"), Width(0.03), F(l / 2)
end)
local result = tree:derive(steps)

-- The number of tips doubles with each fork.
expect(result.counts.Apex, 2 ^ 9)
expect(result.counts.F, 2 ^ 9 - 1)
