--!strict
-- Materials: from chalk to a mirror, and from paint to metal.
local Base, Ball = module("Base"), module("Ball", "column", "row")

local table_of_balls = lsystem({ object = turtle({ sides = 48 }) })
local balls: { any } = { { Base() } }
for column = 0, 4 do
  for row = 0, 2 do
    table.insert(balls, { Ball(column, row) })
  end
end
table_of_balls:axiom(sequence(balls))

table_of_balls:interpret("Base", function(this)
  local low, high = vec(-0.8, -0.8, 0), vec(4.8 * 1.1, 2.8 * 1.1, 0)
  this:color("#6d6258"):mesh({ low, vec(high.x, low.y, 0), high, vec(low.x, high.y, 0) }, { { 1, 2, 3, 4 } })
end)
table_of_balls:interpret("Ball(column, row)", function(this, column, row)
  local kinds = {
    { color = "#b7423a", metallic = 0 },
    { color = "#d8a24a", metallic = 1 },
    { color = "#b9c4cc", metallic = 1 },
  }
  local kind = kinds[row + 1]
  this:material({ color = kind.color, metallic = kind.metallic, roughness = 0.05 + 0.23 * column })
  this:jump({ column * 1.1, row * 1.1, 0.45 }):sphere(0.45)
end)

table_of_balls:derive()
