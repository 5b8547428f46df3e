--!strict
-- A tree that fills a crown: points attract its branches until they are reached (space colonisation).
local points = param("points", { default = 900, min = 50, max = 3000, step = 50, doc = "Number of points" })

-- Points in a ball with its centre 4 m above the ground.
local list = {}
for _ = 1, points do
  local z, turn = random(-1, 1), random(0, 360)
  local away = 2 * random() ^ (1 / 3)
  local flat = away * math.sqrt(1 - z * z)
  table.insert(
    list,
    vec(flat * math.cos(math.rad(turn)), flat * math.sin(math.rad(turn)), 4.2 + 0.85 * away * z)
  )
end
local space = attractors({ points = list, influence = 1.4, kill = 0.28 })

local Bud, Grow = module("Bud", "born"), module("Grow", "x", "y", "z", "step")

local tree = lsystem({ object = turtle({ width = 0.26, sides = 8, color = "#6f563d" }), environment = space })
tree:axiom(F(2.4), Bud(0))
tree:rule("Bud(born)", {
  when = function(this, born)
    return space:count(this:position()) > 0
  end,
}, function(this, born)
  local to = space:direction(this:position())
  return Bud(born), { Grow(to.x, to.y, to.z, step()), Bud(step()) }
end)
tree:interpret("Bud(born)", function(this, born)
  space:add(this:position())
  if born > 16 then
    this:color(choose({ "#6c9445", "#7fa553", "#5c8440" })):sphere(random(0.05, 0.13))
  end
end)
tree:interpret("Grow(x, y, z, step)", function(this, x, y, z, step)
  this:width(math.max(0.015, 0.16 * 0.9 ^ step)):face(vec(x, y, z)):forward(0.2)
end)
tree:derive(40)
