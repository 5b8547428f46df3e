-- Plants that grow until a stronger one takes their space.
local ground = discs({ overlap = 0.3 })
local Seed, Plant = module("Seed", "x", "y"), module("Plant", "x", "y", "radius", "rate")
local field = lsystem({ object = turtle({ color = "#7fa650" }), environment = ground })
local seeds = {}
for i = 1, 120 do
  seeds[i] = Seed(random(-5, 5), random(-5, 5))
end
field:axiom(sequence(seeds))
field:rule("Seed(x, y)", function(this, x, y)
  return Plant(x, y, 0.05, 0.8 + 0.4 * random())
end)
field:rule("Plant(x, y, radius, rate)", function(this, x: number, y: number, radius: number, rate: number)
  if ground:dominated(vec(x, y, 0)) then
    return nil
  end
  return Plant(x, y, radius + 0.1 * rate * (1 - radius), rate)
end)
field:interpret("Plant(x, y, radius, rate)", function(this, x, y, radius, rate)
  ground:add(vec(x, y, 0), radius)
  this:jump(vec(x, y, radius / 2)):sphere(radius)
end)
field:derive(14)
