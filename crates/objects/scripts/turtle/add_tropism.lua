-- Branches that grow level, at 90 degrees to the vertical; on the right, also towards y.
local Limb = module("Limb", "x", "tilt", "strength")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom({ Limb(0, -60, 0) }, { Limb(0, 60, 0) }, { Limb(4, -60, 0.2) }, { Limb(4, 60, 0.2) })
parts:interpret("Limb(x, tilt, strength)", function(this, x, tilt, strength)
  this:jump({ x, 0, 0 }):face({ math.cos(math.rad(tilt)), 0, math.sin(math.rad(tilt)) })
  this:add_tropism({ 0, 0, 1 }, 0.3, 90):add_tropism({ 0, 1, 0 }, strength)
  for _ = 1, 8 do
    this:forward(0.3)
  end
end)
parts:derive()
