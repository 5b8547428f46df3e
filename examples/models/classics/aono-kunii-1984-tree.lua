--!strict
-- A sympodial tree after Aono and Kunii: the trunk forks into two branches at different angles, which do the same in turn,
-- and the wind bends the young ones.
-- Source: M. Aono and T. Kunii, Botanical tree image generation, 1984.
local steps = param("steps", { default = 9, min = 0, max = 11, step = 1, doc = "Number of forks" })
local first =
  param("first", { default = 0.9, min = 0.5, max = 1, doc = "Length of the first branch by its parent" })
local second =
  param("second", { default = 0.8, min = 0.4, max = 1, doc = "Length of the second branch by its parent" })
local angle =
  param("angle", { default = 20, min = 0, max = 60, unit = "deg", doc = "Angle of the first branch" })
local fork =
  param("fork", { default = 50, min = 0, max = 90, unit = "deg", doc = "Angle of the second branch" })
local wind = param("wind", { default = 0.04, min = 0, max = 0.3, doc = "Strength of the wind" })
local THINNER = 0.707 -- the cross-sections of two branches add up to that of their parent

local Apex, Branch = module("Apex", "length", "width"), module("Branch", "length", "width")

local tree = lsystem({
  object = turtle({ color = "#6b4a32", width = 0.22, sides = 5, tropism = { 1, 0, 0 }, elasticity = wind }),
  interpret = "last",
})
tree:axiom(Apex(1, 0.22))
tree:rule("Apex(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Pitch(angle), Branch(l * first, w * THINNER) },
    Roll(180),
    { Pitch(fork), Branch(l * second, w * THINNER) }
end)
-- The branches fork in the plane that is as level as possible.
tree:rule("Branch(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Left(angle), Level(), Branch(l * first, w * THINNER) },
    { Right(fork), Level(), Branch(l * second, w * THINNER) }
end)
tree:interpret("Branch(l, w)", function(this, l)
  return Color("#6f9a3a"), Width(0.04), F(l / 2)
end)
local result = tree:derive(steps)

-- The number of tips doubles with each fork. Branches of a generation are in proportion to (0.9 + 0.8)^n.
expect(result.counts.Branch, 2 ^ 9)
local sum = 0
for length in result.chains[1]:gmatch("Branch%(([%d.e-]+)") do
  sum += tonumber(length) :: number
end
expect(sum, 1.7 ^ 9, 1e-3)
