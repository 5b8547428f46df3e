--!strict
-- Four trees with ternary branching: all segments become longer and thicker in each step, and a tropism bends them.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 2.8.
local letter = param("tree", { default = "a", choices = { "a", "b", "c", "d" }, doc = "Tree of the figure" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Height of the first fork" })

-- The book gives the vectors of the tropism with y upwards.
local TREES: { [string]: any } = {
  a = {
    steps = 6,
    rolls = { 94.74, 132.63 },
    angle = 18.95,
    longer = 1.109,
    pull = { 0, 0, -1 },
    bend = 0.22,
  },
  b = { steps = 8, rolls = { 137.5, 137.5 }, angle = 18.95, longer = 1.109, pull = { 0, 0, -1 }, bend = 0.14 },
  c = {
    steps = 8,
    rolls = { 112.5, 157.5 },
    angle = 22.5,
    longer = 1.79,
    pull = { -0.02, 0, -1 },
    bend = 0.27,
  },
  d = { steps = 6, rolls = { 180, 252 }, angle = 36, longer = 1.07, pull = { -0.61, 0.19, 0.77 }, bend = 0.4 },
}
local THICKER = 1.732 -- the cross-sections of three branches add up to that of their parent

local Apex = module("Apex")

local tree = TREES[letter]
local unit = size / (200 * tree.longer ^ tree.steps + 50 * tree.longer ^ (tree.steps - 1))
local system = lsystem({
  object = turtle({
    tropism = tree.pull,
    elasticity = tree.bend,
    color = "#5e4631",
    sides = 5,
  }),
  interpret = "last",
})
local branch = { Down(tree.angle), F(50), Apex() }
system:axiom(Width(1), F(200), RollRight(45), Apex())
system:rule("Apex", function()
  return Width(THICKER), F(50), branch, RollRight(tree.rolls[1]), branch, RollRight(tree.rolls[2]), branch
end)
system:rule("F(l)", function(this, l: number)
  return F(l * tree.longer)
end)
system:rule("Width(w)", function(this, w: number)
  return Width(w * THICKER)
end)
system:interpret("F(l)", function(this, l)
  this:forward(l * unit)
end)
system:interpret("Width(w)", function(this, w)
  this:width(w / THICKER ^ tree.steps * size / 14)
end)

local derived = system:derive(tree.steps)
-- Three tips replace a tip, with four segments: 1 + 4 (3^n - 1) / 2 segments. The trunk is straight.
expect({ derived.counts.Apex, derived.counts.F }, { 3 ^ tree.steps, 1 + 2 * (3 ^ tree.steps - 1) })
expect(derived.objects[1]:position():distance(vec(0, 0, 10)), 0, 1e-9)

-- Picture: --elevation 6
