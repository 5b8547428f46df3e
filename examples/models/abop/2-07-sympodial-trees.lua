--!strict
-- Four sympodial trees after M. Aono and T. L. Kunii: an apex ends, and two branches of different length continue.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 2.7.
local letter = param("tree", { default = "c", choices = { "a", "b", "c", "d" }, doc = "Tree of the figure" })
local steps = param("steps", { default = 10, min = 1, max = 12, step = 1, doc = "Steps of the derivation" })
local thinner =
  param("thinner", { default = 0.707, min = 0.5, max = 0.9, doc = "Width of a branch by its parent" })

-- Lengths of the two branches by their parent, and their angles to it.
local TREES: { [string]: any } = {
  a = { lengths = { 0.9, 0.7 }, angles = { 5, 65 } },
  b = { lengths = { 0.9, 0.7 }, angles = { 10, 60 } },
  c = { lengths = { 0.9, 0.8 }, angles = { 20, 50 } },
  d = { lengths = { 0.9, 0.8 }, angles = { 35, 35 } },
}

local Stem, Branch = module("Stem", "length", "width"), module("Branch", "length", "width")

local tree = TREES[letter]
local system = lsystem({
  object = turtle({ color = "#5e4631", sides = 6 }),
  interpret = "last",
})
local function shoot(which: number, l: number, w: number): any
  return Branch(l * tree.lengths[which], w * thinner)
end
system:axiom(Stem(1, 0.1))
system:rule("Stem(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Down(tree.angles[1]), shoot(1, l, w) },
    RollRight(180),
    { Down(tree.angles[2]), shoot(2, l, w) }
end)
system:rule("Branch(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Left(tree.angles[1]), Level(), shoot(1, l, w) },
    { Right(tree.angles[2]), Level(), shoot(2, l, w) }
end)

local derived = system:derive(steps)
-- Each tip becomes two tips and an internode.
expect({ derived.counts.Branch, derived.counts.F }, { 2 ^ 10, 2 ^ 10 - 1 })

-- Picture: --elevation 6
