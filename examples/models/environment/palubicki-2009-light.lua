--!strict
-- A tree whose buds compete for light: buds in shade rest, and shoots grow towards the brightest free space.
-- Source: W. Palubicki et al., Self-organizing tree models for image synthesis, 2009, sections 4.2 and 5.
local steps = param("steps", { default = 20, min = 1, max = 30, step = 1, doc = "Steps of the derivation" })
local least = param("least", { default = 0.45, min = 0, max = 1, doc = "Light at which a bud rests, 0 to 1" })

local light = shadow_voxels({ size = 0.25, strength = 0.16, decay = 0.5, depth = 7 })
local Bud, Shoot = module("Bud", "age"), module("Shoot", "direction", "age")

local pen = turtle({ width = 0.05, sides = 8, color = "#5b4130" })
local tree = lsystem({ object = pen, environment = light })

tree:axiom(Shoot(vec(0, 0, 1), 0), Shoot(vec(0, 0, 1), 0), Shoot(vec(0, 0, 1), 0), Bud(0))

tree:rule("Bud(age)", {
  when = function(this)
    return light:light(this:position()) > least
  end,
}, function(this, age)
  local bright = light:brightest(this:position())
  local way = this:heading() * 0.55 + bright * 0.45 + vec(random(-0.1, 0.1), random(-0.1, 0.1), 0.08)
  if age % 2 == 1 then
    return Shoot(way, 0), Roll(137.5), { Turn(random(38, 55)), Bud(age + 2) }, Bud(age + 1)
  end
  return Shoot(way, 0), Bud(age + 1)
end)
tree:rule("Shoot(direction, age)", function(_, direction, age: number)
  return Shoot(direction, age + 1)
end)

tree:interpret("Shoot(direction, age)", function(this, direction, age)
  this:face(direction):width(0.01 + 0.0085 * age):color("#5b4130"):forward(0.25)
end)
tree:interpret("Bud(age)", function(this)
  light:shade(this:position())
  this:color("#5d8f3a"):sphere(0.075)
end)

local derived = tree:derive(steps)
-- Without shade, the numbers of buds are Fibonacci numbers: each odd bud leaves an odd and an even one.
local even, odd = 1, 0
for _ = 1, steps do
  even, odd = odd, even + odd
end
expect(derived.counts.Bud > 60, true)
expect(derived.counts.Bud < (even + odd) / 4, true)

-- Picture: --azimuth 160 --elevation 8
