-- A tent of three poles: lines from the corners to the top.
local Pole = module("Pole", "corner")
local tent = lsystem({ object = turtle({ width = 0.12 }) })
tent:axiom(Pole(polar(1.2, 90)), Pole(polar(1.2, 210)), Pole(polar(1.2, 330)))
tent:interpret("Pole(corner)", function(this, corner)
  this:color("orange"):jump(corner):line_to({ 0, 0, 2 }):color("#7fa650"):forward(0.5)
end)
tent:derive()
