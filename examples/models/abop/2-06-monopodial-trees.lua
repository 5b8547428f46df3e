--!strict
-- Four monopodial trees after H. Honda: the trunk grows straight, and its branches divide in level planes.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 2.6.
local letter = param("tree", { default = "b", choices = { "a", "b", "c", "d" }, doc = "Tree of the figure" })
local steps = param("steps", { default = 10, min = 1, max = 12, step = 1, doc = "Steps of the derivation" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "On the trunk" })
local thinner =
  param("thinner", { default = 0.707, min = 0.5, max = 0.9, doc = "Width of a branch by its parent" })

-- The four trees of the figure: lengths of the next internode and of a branch by the internode; angles of branches to the trunk and of forks.
local TREES: { [string]: any } = {
  a = { trunk = 0.9, branch = 0.6, angle = 45, fork = 45 },
  b = { trunk = 0.9, branch = 0.9, angle = 45, fork = 45 },
  c = { trunk = 0.9, branch = 0.8, angle = 45, fork = 45 },
  d = { trunk = 0.9, branch = 0.7, angle = 30, fork = -30 },
}

local Trunk, Branch = module("Trunk", "length", "width"), module("Branch", "length", "width", "side")

local tree = TREES[letter]
local system = lsystem({
  object = turtle({ width = 0.1, color = "#5e4631", sides = 6 }),
  interpret = "last",
})
system:axiom(Trunk(1, 0.1))
system:rule("Trunk(l, w)", function(this, l: number, w: number)
  return Width(w),
    F(l),
    { Down(tree.angle), Branch(l * tree.branch, w * thinner, -1) },
    RollRight(divergence),
    Trunk(l * tree.trunk, w * thinner)
end)
-- The sides alternate.
system:rule("Branch(l, w, side)", function(this, l: number, w: number, side: number)
  return Width(w),
    F(l),
    { Turn(side * tree.fork), Level(), Branch(l * tree.branch, w * thinner, -side) },
    Branch(l * tree.trunk, w * thinner, -side)
end)

local derived = system:derive(steps)
-- Each tip becomes two tips and an internode; the trunk is a geometric series.
expect({ derived.counts.Branch + derived.counts.Trunk, derived.counts.F }, { 2 ^ 10, 2 ^ 10 - 1 })
expect(derived.objects[1]:position().z, (1 - 0.9 ^ 10) / (1 - 0.9), 1e-9)

-- Picture: --elevation 6
