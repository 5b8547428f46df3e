--!strict
-- Wind: a tropism bends each branch a little with every step, thin branches more than thick ones.
local wind = param("wind", { default = 0.16, min = 0, max = 0.5, doc = "Strength of the wind" })

local Apex, Wood = module("Apex", "length", "width"), module("Wood", "length", "width")

local pine = lsystem({ object = turtle({ color = "#4b4038", tropism = { 1, 0.2, 0.1 }, sides = 8 }) })
pine:axiom(Wood(1.2, 0.3), Apex(0.8, 0.26))
pine:rule("Apex(length, width)", {
  when = function(this, length, width)
    return width > 0.035
  end,
}, function(this, length, width)
  return Wood(length, width),
    { Turn(random(35, 60)), Apex(length * 0.85, width * 0.62) },
    Roll(random(120, 150)),
    { Turn(random(35, 60)), Apex(length * 0.8, width * 0.58) },
    Roll(random(120, 150)),
    Apex(length * 0.92, width * 0.8)
end)
pine:interpret("Wood(length, width)", function(this, length, width)
  this:elasticity(wind * (0.35 - width) / 0.3):width(width)
  for _ = 1, 3 do
    this:forward(length / 3)
  end
end)
-- A flat tuft of needles at each tip.
pine:interpret("Apex(length, width)", function(this, length, width)
  this:width(width):forward(0.2):color(choose({ "#49683c", "#56784a", "#3d5a36" })):sphere(random(0.16, 0.28))
end)
pine:derive()
