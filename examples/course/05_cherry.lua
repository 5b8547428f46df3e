--!strict
-- A cherry tree in blossom: random lengths and angles, and buds that open with a probability.
local years = param("years", { default = 8, min = 2, max = 10, step = 1, doc = "Age of the tree" })
local blossom =
  param("blossom", { default = 5, min = 0, max = 10, doc = "Weight of blossoms among the buds" })

local Shoot = module("Shoot", "length", "width")
local Wood = module("Wood", "length", "width")
local Bud = module("Bud")
local Blossom = module("Blossom", "size")
local Leaf = module("Leaf")

local tree = lsystem({
  object = turtle({ color = "#54423a", sides = 8, tropism = { 0, 0, 1 }, elasticity = 0.2 }),
})

tree:axiom(Wood(1.9, 0.36), Shoot(1.1, 0.32))

-- Two side branches out of three tries, at random angles around the shoot.
tree:rule("Shoot(length, width)", function(this, length, width)
  local parts = { Wood(length, width) }
  for _ = 1, 3 do
    table.insert(parts, Roll(120 + random(-25, 25)))
    if random() < 0.7 then
      local side = Shoot(length * random(0.7, 0.95), width * random(0.45, 0.65))
      table.insert(parts, { Turn(random(28, 50)), side })
    end
    if width < 0.12 then
      table.insert(parts, { Turn(50), Bud() })
    end
  end
  table.insert(parts, Turn(random(-14, 14)))
  table.insert(parts, Shoot(length * random(0.78, 0.92), width * 0.7))
  return sequence(parts)
end)

-- Of all buds, `blossom` in `blossom + 2` become a blossom, one a leaf, and one nothing.
tree:rule("Bud", { weight = blossom }, function(this)
  return Blossom(random(0.1, 0.17))
end)
tree:rule("Bud", { weight = 1 }, function(this)
  return Leaf()
end)
tree:rule("Bud", { weight = 1 }, function(this)
  return nil
end)

tree:interpret("Wood(length, width)", function(this, length, width)
  this:width(width):forward(length)
end)
tree:interpret("Blossom(size)", function(this, size)
  this:color(choose({ "#f6dbe4", "#f2c6d6", "#fbeff3" })):forward(0.05)
  for _ = 1, 5 do
    this:roll(72):mesh({
      { 0, 0, 0 },
      { size * 0.45, size * 0.6, 0.03 },
      { 0, size, 0.06 },
      { -size * 0.45, size * 0.6, 0.03 },
    }, { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } })
  end
end)
tree:interpret("Leaf", function(this)
  this:color("#86a04f"):mesh({ { 0, 0, 0 }, { 0.04, 0.02, 0.08 }, { 0, 0, 0.18 }, { -0.04, 0.02, 0.08 } }, {
    { 1, 2, 3, 4 },
    { 4, 3, 2, 1 },
  })
end)
-- The last shoots are twigs.
tree:interpret("Shoot(length, width)", function(this, length, width)
  this:width(width):forward(length * 0.12)
end)

tree:derive(years)
