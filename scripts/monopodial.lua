--!strict
-- A monopodial tree, after Honda's rules: The Algorithmic Beauty of Plants, figure 2.6. The apex grows straight; its
-- branches divide alternately to the left and to the right, in horizontal planes.
local years = param("years", { default = 11, min = 1, max = 12, step = 1, doc = "How often the apices grow" })
local trunk =
  param("trunk", { default = 0.91, min = 0.7, max = 1, doc = "Length of an internode by the one before" })
local branch =
  param("branch", { default = 0.71, min = 0.4, max = 0.95, doc = "Length of a branch by its parent" })
local angle =
  param("angle", { default = 52, min = 10, max = 90, unit = "deg", doc = "Between trunk and branches" })
local fork = param("fork", { default = 42, min = 10, max = 90, unit = "deg", doc = "Between branches" })
local leaves = param("leaves", { default = true, doc = "Whether twigs bear leaves" })

local GOLDEN = 137.5 -- degrees from one branch of the trunk to the next, as in most plants
local THINNER = 0.707 -- the cross-sections of two branches add up to that of their parent (Leonardo's rule)

local Apex = module("Apex", "length", "width")
local LeftBud = module("LeftBud", "length", "width")
local RightBud = module("RightBud", "length", "width")
local Wood = module("Wood", "length", "width")

-- A leaf is a system of its own, with the two halves of its blade folded along the midrib. It is built once and
-- placed a thousand times.
local leaf = lsystem({ object = turtle({ color = "#6f9a3a", roughness = 0.6 }) })
local function half(side: number)
  return {
    Roll(side * 20),
    BeginPolygon(),
    Point(),
    { Turn(side * 42), G(0.45), Point() },
    { Turn(side * 22), G(0.8), Point() },
    { G(1.1), Point() },
    EndPolygon(),
  }
end
leaf:axiom(half(1), half(-1))
local blade = leaf:derive()

local tree = lsystem({
  object = turtle({ color = "#6b4a32", elasticity = -0.03 }),
  interpret = "last",
})

tree:axiom(Wood(1.3, 0.42), Apex(1.25, 0.36))

tree:rule("Apex(l, w)", function(this, l, w)
  return Wood(l, w),
    { Pitch(angle), LeftBud(l * branch, w * THINNER) },
    Roll(GOLDEN),
    Apex(l * trunk, w * THINNER)
end)

tree:rule("LeftBud(l, w)", function(this, l, w)
  return Wood(l, w),
    { Turn(-fork), Level(), RightBud(l * branch, w * THINNER) },
    RightBud(l * trunk, w * THINNER)
end)

tree:rule("RightBud(l, w)", function(this, l, w)
  return Wood(l, w),
    { Turn(fork), Level(), LeftBud(l * branch, w * THINNER) },
    LeftBud(l * trunk, w * THINNER)
end)

-- Young wood has leaves on both sides.
tree:interpret("Wood(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)

local function sprig(this)
  if leaves then
    this:place(blade, 0.26)
    this:turn(60)
    this:place(blade, 0.26)
    this:turn(-120)
    this:place(blade, 0.26)
  end
end
tree:interpret("LeftBud", sprig)
tree:interpret("RightBud", sprig)
tree:interpret("Apex", sprig)

tree:derive(years)
