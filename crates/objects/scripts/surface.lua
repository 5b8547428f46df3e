-- A flower whose petals open from bud to mature form.
local function petal(width: number, bend: number): Surface
  return surface({
    { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
    { vec(-width, 0.1, 0.4), vec(-width / 3, 0, 0.4), vec(width / 3, 0, 0.4), vec(width, 0.1, 0.4) },
    { vec(-width, bend, 0.9), vec(-width / 3, 0, 0.9), vec(width / 3, 0, 0.9), vec(width, bend, 0.9) },
    { vec(0, bend, 1.3), vec(0, bend, 1.3), vec(0, bend, 1.3), vec(0, bend, 1.3) },
  })
end
local bud, mature = petal(0.2, -0.2), petal(0.6, 0.5)
local Petal = module("Petal", "age")
local flower = lsystem({ object = turtle({ color = "#b0568a" }) })
flower:axiom(
  { Petal(0.1) },
  Roll(72),
  { Petal(0.3) },
  Roll(72),
  { Petal(0.5) },
  Roll(72),
  { Petal(0.7) },
  Roll(72),
  { Petal(1) }
)
flower:interpret("Petal(age)", function(this, age)
  this:pitch(20 + 40 * age):surface(bud:mix(mature, age))
end)
flower:derive()
