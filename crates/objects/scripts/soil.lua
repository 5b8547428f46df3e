-- Roots that grow towards water, and take it.
local ground = soil({ size = { 4, 4, 3 }, cell = 0.2, amount = 1, diffusion = 0.002 })
local Tip, Step = module("Tip", "width"), module("Step", "x", "y", "z")
local roots = lsystem({ object = turtle({ sides = 6, color = "#b08d62" }), environment = ground })
roots:axiom(
  Turn(90),
  Pitch(90),
  Tip(0.12),
  Roll(120),
  { Pitch(50), Tip(0.1) },
  Roll(120),
  { Pitch(50), Tip(0.1) }
)
roots:rule("Tip(width)", function(this, width: number)
  local place = this:position()
  local found = ground:taken(place)
  if found < 0.1 then
    return nil
  end
  local way = this:heading() + 0.6 * ground:gradient(place, 0.6)
  local on = Step(way.x, way.y, way.z)
  if found > 0.4 and random() < 0.35 then
    return Width(width), on, { Turn(45), Tip(width * 0.7) }, Roll(120), Tip(width * 0.95)
  end
  return Width(width), on, Roll(50), Tip(width * 0.97)
end)
roots:interpret("Tip(width)", function(this)
  ground:take(this:position(), 0.3, 0.8)
end)
roots:interpret("Step(x, y, z)", function(this, x, y, z)
  this:face(vec(x, y, z)):forward(0.16)
end)
roots:derive(18)
