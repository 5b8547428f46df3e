-- Two branches and a trunk that are one surface.
local Limb = module("Limb", "angle", "width")
local limbs = lsystem({ object = turtle({ width = 0.24, sides = 16, joints = "smooth", color = "#8a6f52" }) })
limbs:axiom(F(1), { Limb(50, 0.14) }, { Limb(-35, 0.18) })
limbs:interpret("Limb(angle, width)", function(this, angle, width)
  this:turn(angle):width(width):forward(0.6):turn(-angle / 2):width(0.06):forward(0.6)
end)
limbs:derive()
