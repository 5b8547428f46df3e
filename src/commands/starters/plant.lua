--!strict
-- A young tree. Change a number, save, and watch the live view.
local age = param("age", { default = 8, min = 1, max = 10, step = 1, unit = "years" })
local spread = param("spread", { default = 34, min = 5, max = 80, unit = "deg" })

-- A module is a symbol with values. An apex is a growing tip, an internode the wood below it.
local Apex = module("Apex", "length", "width")
local Internode = module("Internode", "length", "width")
local Leaf = module("Leaf", "size")

local tree = lsystem({ object = turtle({ sides = 8, color = "#6d5138" }) })

tree:axiom(Apex(1, 0.18))

-- In each step, an apex becomes an internode, two side branches in braces, and the next apex.
tree:rule("Apex(l, w)", function(this, l, w)
  return Internode(l, w),
    { Turn(spread), Apex(l * random(0.68, 0.8), w * 0.62) },
    Roll(137.5),
    { Turn(-spread), Apex(l * random(0.62, 0.74), w * 0.58) },
    Roll(137.5),
    Turn(random(-6, 6)),
    Apex(l * 0.86, w * 0.76)
end)

-- The last apexes bear leaves.
tree:interpret("Apex(l, w)", function(this, l, w)
  return Leaf(0.3), Pitch(60), Roll(120), Leaf(0.26)
end)

tree:interpret("Internode(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)

tree:interpret("Leaf(size)", function(this, size)
  this:color(choose({ "#5f8f3a", "#6fa044", "#82ad4c" }))
  this:mesh(
    { { 0, 0, 0 }, { size / 3, 0.05, size / 2 }, { 0, 0.1, size }, { -size / 3, 0.05, size / 2 } },
    { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } }
  )
end)

tree:derive(age)
