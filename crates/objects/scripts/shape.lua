--!strict
-- A mass is divided into storeys, and the top storey gets a roof.
local Mass, Storey = module("Mass", "shape"), module("Storey", "shape")

local house = lsystem({ object = extruder({ color = "#d9c7a8" }) })
house:axiom(Mass(cuboid(12, 8, 7)))
house:rule("Mass(s)", function(this, s: Shape)
  local roof = s:faces("top")[1]:roof({ kind = "gable", overhang = 0.4 }):color("#8a4b3a")
  return Draw(roof), split(s, "z", { { 4, Storey }, { "~3", Storey } })
end)
house:rule("Storey(s)", function(this, s: Shape)
  return Draw(if s:index() == 1 then s:color("#a89a86") else s)
end)
house:derive()
