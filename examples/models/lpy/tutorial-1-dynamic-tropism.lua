--!strict
-- Tropism towards a point: each segment bends to a sphere, from its own place. Thick segments bend less.
-- Source: L-Py, tutorial/01 - turtle/11 - dynamictropism, F. Boudon and C. Godin.
local height = param("height", { default = 5, min = 1, max = 12, unit = "m", doc = "Of the sphere" })
local distance = param("distance", { default = 5, min = 0.5, max = 12, unit = "m", doc = "Of the sphere" })
local shoots = param("shoots", { default = 9, min = 1, max = 24, step = 1, doc = "Shoots on a circle" })
local segments = param("segments", { default = 14, min = 1, max = 40, step = 1, doc = "Segments of a shoot" })

local Shoot, Segment, Target = module("Shoot", "left"), module("Segment", "left"), module("Target")
local target = vec(distance, 0, height)

local scene = lsystem({ object = turtle({ color = "#7a5a3a", sides = 10 }), interpret = "last" })
local circle: { any } = { { Target() } }
for number = 1, shoots do
  table.insert(circle, Roll(360 / shoots))
  local shoot: { any } = { Pitch(90), G(2.5), Up(90), Shoot(segments) }
  table.insert(circle, if number < shoots then shoot else sequence(shoot))
end
scene:axiom(sequence(circle))
scene:rule("Shoot(left)", {
  when = function(this, left)
    return left > 0
  end,
}, function(this, left)
  return Segment(left), Shoot(left - 1)
end)
scene:interpret("Segment(left)", function(this, left)
  local width = 0.05 + 0.25 * left / segments
  local pull = target - this:position()
  -- Above the sphere, nothing pulls any more.
  if this:position().z < target.z then
    this:tropism(pull, 0.32 - width / 2)
  else
    this:elasticity(0)
  end
  this:width(width):forward(0.6)
end)
scene:interpret("Shoot", function(this)
  this:color("#5f9440"):sphere(0.12)
end)
scene:interpret("Target", function(this)
  this:jump(target):color("#e0a830"):sphere(0.5)
end)
local result = scene:derive()

-- Each shoot makes a segment in each step.
expect(result.counts.Segment, 9 * 14)
-- A shoot stays in the vertical plane of its foot and the sphere.
local heading, away = result.objects[1]:heading(), target - result.objects[1]:position()
expect(heading.x * away.y - heading.y * away.x, 0, 1e-9)
-- Picture: --azimuth 190 --elevation 14
