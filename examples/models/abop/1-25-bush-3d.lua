--!strict
-- A bush in three dimensions: an apex becomes three branches, segments grow in length and bear leaves.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.25.
local steps = param("steps", { default = 7, min = 1, max = 8, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 22.5, min = 5, max = 45, unit = "deg", doc = "Of all turns" })
local taper =
  param("taper", { default = 0.55, min = 0.3, max = 0.9, doc = "Width of a branch by its parent" })

local Apex = module("Apex", "width")
local Shoot, Leaf = module("Shoot"), module("Leaf")

-- A hexagon with edges of 1 m, from its base to its tip and back.
local leaf = lsystem({ object = turtle({ angle = angle, color = "#5d9440" }) })
local Side = module("Side")
leaf:axiom("{ Side | Side }")
leaf:interpret("Side", function()
  return Right(), G(), Point(), Left(), G(), Point(), Left(), G(), Point(), Right()
end)
local blade = leaf:derive(0)

local bush = lsystem({
  object = turtle({ angle = angle, width = 0.5, color = "#6b4a32", sides = 6 }),
  interpret = "last",
})
bush:axiom(Apex(0.5))
bush:rule("Apex(w)", function(this, w: number)
  local branch = { Down(), F(), Leaf(), Width(w * taper), Apex(w * taper) }
  return branch, RollRight(5 * angle), branch, RollRight(7 * angle), branch
end)
bush:rule("F", function()
  return Shoot(), RollRight(5 * angle), F()
end)
bush:rule("Shoot", "F Leaf")
bush:interpret("Leaf", function(this)
  this:pitch_up(2 * angle)
  this:place(blade)
end)

-- Segments and leaves: f(n + 1) = f(n) + f(n - 1) + 3^(n + 1), that is 3, 12, 42, 135, 420, 1284, 3891.
local counts = bush:derive(steps).counts
expect({ counts.Apex, counts.F, counts.Leaf, counts.Shoot }, { 3 ^ 7, 3891, 3891, 1284 })
