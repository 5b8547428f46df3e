--!strict
-- A knotted pipe: a smooth tube along a curve that closes on itself.
local turns = param("turns", { default = 3, min = 2, max = 7, step = 1, doc = "Turns around the ring" })

local Knot = module("Knot")

local points = {}
for number = 0, 29 do
  local angle = math.rad(12 * number)
  local away = 2 + 0.8 * math.cos(turns * angle)
  table.insert(
    points,
    vec(away * math.cos(2 * angle), away * math.sin(2 * angle), 1.2 + 0.8 * math.sin(turns * angle))
  )
end
local path = curve({ points = points, closed = true })

local knot = lsystem({ object = turtle({ width = 0.55, sides = 48, color = "#2f8f8a", roughness = 0.2 }) })
knot:axiom(Knot())
-- A generalised cylinder is one smooth surface along the way of the turtle.
knot:interpret("Knot", function(this)
  this:jump(path:point(0)):begin_cylinder()
  for piece = 1, 202 do
    local to = path:point(piece / 200)
    this:face(to - this:position()):forward(to:distance(this:position()))
  end
  this:end_cylinder()
end)
knot:derive()
