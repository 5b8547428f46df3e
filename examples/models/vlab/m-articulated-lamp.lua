--!strict
-- An articulated lamp: a chain of links and joints, which interpretations draw.
-- Source: Virtual Laboratory (cpfg), CPFG manual, ArticulatedLamp, University of Calgary.
local turn = param("turn", { default = 0, min = -180, max = 180, unit = "deg", doc = "Rotation of the lamp" })
local shoulder =
  param("shoulder", { default = -45, min = -90, max = 90, unit = "deg", doc = "Angle of the lower arm" })
local elbow =
  param("elbow", { default = 100, min = -150, max = 150, unit = "deg", doc = "Angle between the arms" })
local head = param("head", { default = -15, min = -90, max = 90, unit = "deg", doc = "Angle of the head" })

local Base, Link, Shade = module("Base"), module("Link", "length"), module("Shade")

local lamp = lsystem({ object = turtle({ color = "#b5382c", roughness = 0.4, sides = 24, width = 0.12 }) })
lamp:axiom(
  Base(),
  Roll(turn),
  Link(0.1),
  Pitch(shoulder),
  Link(1),
  Pitch(elbow),
  Link(1),
  Pitch(head),
  Link(0.15),
  Shade()
)
lamp:interpret("Base", function()
  return Width(1), F(0.05), Width(0.12), F(0.1)
end)
lamp:interpret("Link(length)", function(this, length: number)
  return F(length), Sphere(0.09)
end)
lamp:interpret("Shade", function()
  return Width(0.3), F(0.02), F(0.28), { Color("#fff3c0"), G(0.15), Sphere(0.22) }, Width(0.75), F(0.25)
end)
local result = lamp:derive(0)

-- The arms point 45 degrees back, 55 degrees forward and 40 degrees forward of the vertical.
local function reach(f: (number) -> number): number
  return f(math.rad(-45)) + f(math.rad(55)) + (0.15 + 0.02 + 0.28 + 0.25) * f(math.rad(40))
end
local tip = result.objects[1]:position()
expect(tip.z, 0.05 + 0.1 + 0.1 + reach(math.cos), 1e-9)
expect(math.abs(tip.y), reach(math.sin), 1e-9)
-- Picture: --azimuth 110 --elevation 10
