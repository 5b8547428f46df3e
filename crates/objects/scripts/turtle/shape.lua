-- A ball, a cone and a cylinder, drawn where the turtle stands.
local Part = module("Part")
local parts = lsystem({ object = turtle({ color = "#5f7f9a" }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  this
    :shape(ball(1):translate(vec(0, 0, 1)))
    :jump(vec(3, 0, 0))
    :shape(cone(1, 2))
    :jump(vec(6, 0, 0))
    :shape(cylinder(1, 2))
end)
parts:derive()
