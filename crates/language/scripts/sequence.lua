-- A rule that makes its modules in a loop.
local Row = module("Row", "posts")
local fence = lsystem({ object = turtle({ width = 0.05 }) })
fence:axiom(Turn(90), Row(6))
fence:rule("Row(posts)", function(this, posts)
  local list = {}
  for _ = 1, posts do
    table.insert(list, { Turn(-90), F(1) })
    table.insert(list, F(0.4))
  end
  return sequence(list)
end)
fence:derive(1)
