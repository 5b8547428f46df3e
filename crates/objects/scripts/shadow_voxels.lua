-- A shoot that leans away from the shadow of a wall of leaves, towards the light.
local light = shadow_voxels({ size = 0.25, strength = 0.1, depth = 12, decay = 0.9 })
local Wall, Shoot, Lean = module("Wall", "x", "z"), module("Shoot", "size"), module("Lean", "x", "y", "z")
local garden = lsystem({ object = turtle({ width = 0.08, color = "#5d4a32" }), environment = light })
local leaves = {}
for i = 1, 300 do
  leaves[i] = Wall(random(-1, 1), random(2, 3))
end
garden:axiom(sequence(leaves), Shoot(0.25))
garden:rule("Shoot(size)", function(this, size: number)
  local place = this:position()
  local up = (this:heading() + 0.5 * light:brightest(place)):unit()
  return Lean(up.x, up.y, up.z), F(size), { Turn(60), Roll(90), F(size / 2) }, Shoot(size * 0.97)
end)
garden:interpret("Lean(x, y, z)", function(this, x, y, z)
  this:face(vec(x, y, z))
end)
garden:interpret("Wall(x, z)", function(this, x, z)
  local place = vec(x, 1 + random(-0.2, 0.2), z)
  light:shade(place, 0.4)
  this:color("#5d8f3c"):jump(place):sphere(0.12):jump(vec(0, 0, 0)):color("#5d4a32")
end)
garden:derive(18)
