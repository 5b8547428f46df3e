--!strict
-- Organs in a helix on a cylinder, with a constant divergence angle and a constant rise.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.10.
local organs = param("organs", { default = 200, min = 1, max = 2000, step = 1, doc = "Number of organs" })
local divergence =
  param("divergence", { default = 137.5281, min = 0, max = 180, unit = "deg", doc = "Between organs" })
local rise = param("rise", { default = 3.53, min = 0.1, max = 20, unit = "mm", doc = "Between organs" })
local radius = param("radius", { default = 50, min = 1, max = 500, unit = "mm", doc = "Of the cylinder" })

local Apex = module("Apex")
local cylinder = lsystem({ object = turtle({ sides = 12, roughness = 0.6 }), interpret = "last" })
cylinder:axiom(Color("#7d9a4a"), Apex())
cylinder:rule("Apex", function()
  local organ = Color(if step() % 8 == 0 then "#c8452f" else "#8fae58")
  return G(rise / 1000), { Down(90), G(radius / 1000), organ, Sphere(0.014) }, RollRight(divergence), Apex()
end)

local derived = cylinder:derive(organs)
-- The axis rises by 3.53 mm with each organ. Every eighth organ is red: they are parastichies.
expect(derived.counts.Sphere, 200)
expect(derived.objects[1]:position().z, 200 * 0.00353, 1e-9)

-- Picture: --azimuth 180 --elevation 5
