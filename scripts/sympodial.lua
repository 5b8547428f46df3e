--!strict
-- A sympodial flowering tree, after Aono and Kunii: The Algorithmic Beauty of Plants, figure 2.7. Each axis ends in
-- two branches, so the apparent trunk is a row of branches.
local years =
  param("years", { default = 9, min = 1, max = 11, step = 1, doc = "How often the branches fork" })
local first =
  param("first", { default = 0.88, min = 0.5, max = 1, doc = "Length of the stronger branch by its parent" })
local second = param("second", { default = 0.8, min = 0.4, max = 1, doc = "Length of the weaker one" })
local inner =
  param("inner", { default = 26, min = 0, max = 80, unit = "deg", doc = "Angle of the stronger branch" })
local outer =
  param("outer", { default = 42, min = 0, max = 80, unit = "deg", doc = "Angle of the weaker one" })
local petals = param("petals", { default = "#f6c3d0", doc = "Colour of the flowers" })

local Trunk = module("Trunk", "length", "width")
local Fork = module("Fork", "length", "width")
local Wood = module("Wood", "length", "width")
local Petal = module("Petal")

-- A flower is a system of its own: five petals around a centre. It is built once and placed a thousand times.
local flower = lsystem({ object = turtle({ sides = 6, roughness = 0.7 }) })
local whorl = { { Color("#b8405f"), G(0.1), Sphere(0.16) }, Color(petals) }
for k = 1, 5 do
  table.insert(whorl, { Roll(k * 72), Turn(58), Petal() })
end
flower:axiom(table.unpack(whorl))
flower:rule("Petal", function()
  return BeginPolygon(),
    Point(),
    { Turn(34), G(0.65), Point() },
    { Turn(16), G(1), Point() },
    { Turn(-16), G(1), Point() },
    { Turn(-34), G(0.65), Point() },
    EndPolygon()
end)
local blossom = flower:derive()

local tree = lsystem({ object = turtle({ color = "#54413b", elasticity = -0.03 }), interpret = "last" })

tree:axiom(Wood(0.5, 0.5), Trunk(1.3, 0.42))

tree:rule("Trunk(l, w)", function(this, l, w)
  local branches = { Wood(l, w) }
  for k = 1, 3 do
    table.insert(branches, { Roll(k * 120), Turn(outer), Fork(l * (0.8 + 0.1 * k), w * 0.68) })
  end
  return table.unpack(branches)
end)

-- Both branches are in a plane that is as level as possible; the stronger branch continues the wood.
tree:rule("Fork(l, w)", function(this, l, w)
  return Wood(l, w),
    { Turn(-outer), Level(), Fork(l * second, w * 0.62) },
    Turn(inner),
    Level(),
    Fork(l * first, w * 0.76)
end)

tree:interpret("Wood(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)

-- Growing branches have flowers along their whole length.
tree:interpret("Fork(l, w)", function(this, l, w)
  for _ = 1, 6 do
    this:width(w):forward(l * 0.2)
    this:roll(137.5):turn(55)
    this:place(blossom, 0.11)
    this:turn(-55)
  end
end)

tree:derive(years)
