-- Claims of shapes with labels, in an order, and distances to them, their ranks by height, and lines of sight.
local Lot = module("Lot", "shape")
local space = volumes()
local town = lsystem({ object = extruder(), environment = { space } })
town:axiom(
  Lot(cuboid(8, 8, 5)),
  Lot(cuboid(8, 8, 5):translate(vec(6, 0, 0))),
  Lot(cuboid(8, 8, 9):translate(vec(20, 0, 0)))
)
town:rule("Lot(s)", function(this, s: Shape)
  print(
    space:has(s),
    space:count("house"),
    space:is_free(s:translate(vec(0, 30, 0))),
    space:distance(s, "house"),
    space:rank(s:size().z, "house"),
    space:is_visible(s:center() + vec(0, 0, 6), vec(60, 4, 4))
  )
  return Draw(s)
end)
town:interpret("Lot(s)", function(this, s: Shape)
  space:claim(s, "house", s:size().z)
end)
town:derive(1)
