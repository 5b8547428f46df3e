-- A hedge that grows only inside of two balls, and is cut at the surface.
local shape = obstacles():sphere({ 0, 0, 1.6 }, 1):sphere({ 0, 0, 3 }, 0.6)
local Bud = module("Bud", "length")
local hedge = lsystem({ object = turtle({ width = 0.03, sides = 6, color = "#5d8f3c" }) })
hedge:axiom(F(0.8), Bud(0.4))
hedge:rule("Bud(length)", function(this, length: number)
  local place: Vector, heading: Vector = this:position(), this:heading()
  local tip = place + heading * length
  if place.z > 1 and not shape:contains(tip) then
    return F(-shape:distance(place)), Cut()
  end
  return F(length),
    { Turn(50), Bud(length * 0.85) },
    Roll(90),
    { Turn(-40), Bud(length * 0.85) },
    Roll(70),
    Bud(length)
end)
hedge:derive(9)
