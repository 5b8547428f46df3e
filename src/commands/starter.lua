--!strict
-- A young tree. Change a number, run again, and see what becomes of it.
local age = param("age", { default = 7, min = 1, max = 10, step = 1, unit = "years" })
local spread = param("spread", { default = 32, min = 5, max = 80, unit = "deg" })

local Apex = module("Apex", "length", "width")
local Internode = module("Internode", "length", "width")

local tree = lsystem({ object = turtle({ sides = 8, color = "#7a5230" }) })

tree:axiom(Apex(1, 0.16))

-- A growing tip makes a piece of branch, two side branches, and goes on.
tree:rule("Apex(l, w)", function(this, l, w)
  return Internode(l, w),
    { Turn(spread), Apex(l * 0.75, w * 0.65) },
    Roll(137.5),
    { Turn(-spread), Apex(l * 0.7, w * 0.6) },
    Roll(137.5),
    Apex(l * 0.85, w * 0.75)
end)

tree:interpret("Internode(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)

tree:derive(age)
