--!strict
-- Shoots along a guide curve: the turtle takes short steps and turns as the curve does, whatever its own direction is.
-- Source: L-Py, tutorial/01 - turtle/06 - setguide, F. Boudon and C. Godin.
local shoots = param("shoots", { default = 9, min = 1, max = 30, step = 1, doc = "Number of shoots" })
local length = param("length", { default = 10, min = 1, max = 40, unit = "m", doc = "Length of a shoot" })
local steps = param("steps", { default = 60, min = 4, max = 400, step = 1, doc = "Steps of a shoot" })

local Shoot = module("Shoot", "heading")

-- Four control points are one cubic piece.
local guide = curve({
  points = { { -0.5, 0 }, { -0.192641, 0.281385 }, { 0.0238095, -0.177489 }, { 0.5, 0 } },
  kind = "bezier",
})

local plant = lsystem({ object = turtle({ color = "#4f7f3a", sides = 12, width = 0.3 }) })
local fan: { any } = {}
for k = 1, shoots - 1 do
  table.insert(fan, { Shoot(-80 + 160 * (k - 1) / (shoots - 1)) })
end
table.insert(fan, Shoot(80))
plant:axiom(sequence(fan))
plant:interpret("Shoot(heading)", function(this, heading)
  this:turn(heading):begin_cylinder()
  local scale = length / guide:length()
  -- Directions of the curve, from its x axis to the heading.
  local before = 0
  for k = 1, steps do
    local chord = guide:point(k / steps) - guide:point((k - 1) / steps)
    local direction = math.deg(math.atan2(chord.y, chord.x))
    this:turn(direction - before):width(0.3 * (1 - k / steps)):forward(scale * chord:length())
    before = direction
  end
  this:end_cylinder()
end)
local result = plant:derive(0)

-- The ends of the guide are 1 m apart, so the ends of a shoot are as far apart as it is longer than the guide.
expect(result.objects[1]:position():length(), 10 / guide:length(), 1e-9)
-- Picture: --azimuth 180 --elevation 0
