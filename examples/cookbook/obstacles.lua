--!strict
-- A creeper on a block: a shoot follows the surface, and turns away before it grows into it.
local reach =
  param("reach", { default = 26, min = 5, max = 60, step = 1, doc = "Length of a shoot in steps" })

local block = obstacles():box({ -0.8, -0.8, 0 }, { 0.8, 0.8, 2.2 }):sphere({ 0, 0, 2.6 }, 0.75)

local Block, Shoot, Step = module("Block"), module("Shoot", "left"), module("Step", "x", "y", "z")
local Leaf = module("Leaf")

local creeper = lsystem({ object = turtle({ width = 0.025, color = "#6b5a3c", sides = 6 }) })
local modules: { any } = { { Block() } }
for number = 0, 17 do
  local angle = math.rad(number * 20)
  local start = vec(1.15 * math.cos(angle), 1.15 * math.sin(angle), 0)
  table.insert(modules, { Step(start.x, start.y, 0), Shoot(reach) })
end
creeper:axiom(sequence(modules))

creeper:rule("Shoot(left)", {
  when = function(this, left)
    return left > 0
  end,
}, function(this, left)
  local place: Vector, heading: Vector = this:position(), this:heading()
  -- Upwards, a little to a side, and towards a distance of 4 cm from the surface.
  local off = block:distance(place) - 0.04
  local aim = vec(random(-0.8, 0.8), random(-0.8, 0.8), 0.9) + heading * 0.8 - block:normal(place) * (off * 8)
  local to = place + aim:unit() * 0.14
  if block:contains(to) then
    to = block:nearest(to) + block:normal(to) * 0.04
  end
  local side = if random() < 0.12 then { Shoot(left - 4) } else {}
  return Step(to.x, to.y, to.z), { Leaf() }, side, Shoot(left - 1)
end)

creeper:interpret("Block", function(this)
  this:color("#b9ab95"):jump({ -0.8, -0.8, 0 }):mesh({
    { 0, 0, 0 },
    { 1.6, 0, 0 },
    { 1.6, 1.6, 0 },
    { 0, 1.6, 0 },
    { 0, 0, 2.2 },
    { 1.6, 0, 2.2 },
    { 1.6, 1.6, 2.2 },
    { 0, 1.6, 2.2 },
  }, { { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 }, { 4, 1, 5, 8 }, { 5, 6, 7, 8 }, { 4, 3, 2, 1 } })
  this:jump({ 0, 0, 2.6 }):sphere(0.75)
end)
creeper:interpret("Step(x, y, z)", function(this, x, y, z)
  local to, from = vec(x, y, z), this:position()
  if z == 0 then
    this:jump(to):face(vec(0, 0, 1))
  else
    this:face(to - from):forward(from:distance(to))
  end
end)
creeper:interpret("Leaf", function(this)
  local size = random(0.1, 0.17)
  this
    :color(choose({ "#4d7a37", "#5f8f40", "#76a34a" }))
    :face(block:normal(this:position()) + vec(0, 0, -0.7))
  this:roll(random(-40, 40)):mesh(
    { { 0, 0, 0 }, { size * 0.5, 0, size * 0.4 }, { 0, 0, size }, { -size * 0.5, 0, size * 0.4 } },
    { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } }
  )
end)

creeper:derive()
