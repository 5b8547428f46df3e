-- Twigs with leaves on both sides that begin on edge; a torque rolls the twig behind until they face upwards.
local Twig = module("Twig", "y", "strength")
local twigs = lsystem({ object = turtle({ width = 0.05, color = "#7a6248" }) })
twigs:axiom({ Twig(0, 0) }, { Twig(1.6, 0.35) })
twigs:interpret("Twig(y, strength)", function(this, y, strength)
  this:jump({ 0, y, 0 }):face({ 1, 0, 0.1 }):level():roll(80):add_torque({ 0, 0, 1 }, strength)
  for _ = 1, 9 do
    this:color("#7a6248"):forward(0.3):color("#5f9a3c")
    local base, along, left = this:position(), this:heading(), this:left()
    for side = -1, 1, 2 do
      this:begin_polygon()
      for _, corner in { { 0, 0 }, { 0, 0.2 }, { 0.1, 0.36 }, { 0.24, 0.46 }, { 0.26, 0.28 }, { 0.18, 0.1 } } do
        this:jump(base + along * corner[1] + left * corner[2] * side):point()
      end
      this:end_polygon()
    end
    this:jump(base)
  end
end)
twigs:derive()
