--!strict
-- A branching pattern whose branches become shorter by a constant ratio, so that the tips nearly fill a rectangle.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.39.
local steps = param("steps", { default = 10, min = 1, max = 13, step = 1, doc = "Steps of the derivation" })
local ratio =
  param("ratio", { default = 1.456, min = 1.1, max = 2, doc = "Length of a branch by the next ones" })
local angle = param("angle", { default = 85, min = 20, max = 120, unit = "deg", doc = "Of the branches" })

local Apex = module("Apex", "length")
local pattern =
  lsystem({ object = turtle({ width = 0.012, color = "#5a4632", sides = 4 }), interpret = "last" })
pattern:axiom(Apex(1))
pattern:rule("Apex(s)", function(this, s: number)
  return F(s), { Left(angle), Apex(s / ratio) }, { Right(angle), Apex(s / ratio) }
end)

-- 2^10 apices, and 1 + 2 + 4 + ... + 2^9 branches.
local counts = pattern:derive(steps).counts
expect({ counts.Apex, counts.F }, { 2 ^ 10, 2 ^ 10 - 1 })

-- Picture: --azimuth 180 --elevation 0
