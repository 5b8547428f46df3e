--!strict
-- The dragon curve with diagonal edges: each edge becomes two edges at a right angle, alternately left and right.
-- Source: Virtual Laboratory (cpfg), CPFG manual, DragonCurve, University of Calgary.
local steps = param("steps", { default = 10, min = 0, max = 14, step = 1, doc = "Steps" })
local color = param("color", { default = "#a03c2e", doc = "Colour of the curve" })

local LeftEdge, RightEdge = module("LeftEdge"), module("RightEdge")

local curve = lsystem({ object = turtle({ angle = 45, width = 0.35, color = color }), interpret = "last" })
curve:axiom(LeftEdge())
curve:rule("LeftEdge", function()
  return Left(), LeftEdge(), Right(90), RightEdge(), Left()
end)
curve:rule("RightEdge", function()
  return Right(), LeftEdge(), Left(90), RightEdge(), Right()
end)
for _, name in { "LeftEdge", "RightEdge" } do
  curve:interpret(name, function()
    return F(1)
  end)
end
local dragon = curve:derive(steps)

-- The number of edges doubles; the distance of the ends grows by sqrt(2), and the direction stays.
expect(dragon.counts.LeftEdge + dragon.counts.RightEdge, 2 ^ 10)
expect(dragon.objects[1]:position():distance(vec(0, 0, 32)), 0, 1e-9)
-- Picture: --azimuth 180 --elevation 0
