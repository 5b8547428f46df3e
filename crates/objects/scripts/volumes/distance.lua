-- Claims of shapes with labels, in an order, and distances to them.
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
    space:distance(s, "house")
  )
  return Draw(s)
end)
town:interpret("Lot(s)", function(this, s: Shape)
  space:claim(s, "house")
end)
town:derive(1)
