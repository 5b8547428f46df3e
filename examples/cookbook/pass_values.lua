--!strict
-- A wave in a row of posts: each post takes the height of its left neighbour, so a pulse runs through the row.
local steps = param("steps", { default = 39, min = 0, max = 60, step = 1, doc = "Time of the wave" })

local Source = module("Source", "time")
local Post = module("Post", "height")

local row = lsystem({ object = extruder({ sides = 24 }) })

local posts: { any } = { Source(0) }
for _ = 1, 40 do
  table.insert(posts, Post(0.3))
end
row:axiom(sequence(posts))

row:rule("Source(time)", "Source(time + 1)")
-- The names of the left context are arguments too, in the order of the pattern.
row:rule("Source(time) < Post(height)", function(this, time: number, height)
  return Post(1.2 - 0.9 * math.cos(time * 0.5))
end)
row:rule("Post(left) < Post(height)", function(this, left, height)
  return Post(left)
end)

row:interpret("Post(height)", function(this, height)
  local x = this:position().x + 0.34
  this:color(mix("#2f5d7c", "#e2a24b", (height - 0.3) / 1.8)):jump({ x, 0, 0 }):scale(0.15):extrude(height)
end)

row:derive(steps)
