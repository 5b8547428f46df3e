--!strict
-- Organs in a helix on a cylinder, with a constant divergence angle and a constant rise.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.10.
local organs = param("organs", { default = 200, min = 1, max = 2000, step = 1, doc = "Number of organs" })
local divergence =
  param("divergence", { default = 137.5281, min = 0, max = 180, unit = "deg", doc = "Between organs" })
local rise = param("rise", { default = 3.53, min = 0.1, max = 20, unit = "mm", doc = "Between organs" })
local radius = param("radius", { default = 50, min = 1, max = 500, unit = "mm", doc = "Of the cylinder" })

-- On the unrolled cylinder, the organs 5 and 8 older are at the same distance (mm); organs of that size touch.
local function distance(n: number): number
  local turn = n * divergence / 360
  local aside = 2 * math.pi * radius * (turn - math.round(turn))
  return math.sqrt(aside ^ 2 + (n * rise) ^ 2)
end
expect(distance(5), distance(8), 0.01)
local size = distance(8) / 2 / 1000

local Core, Apex = module("Core"), module("Apex")
local cylinder = lsystem({ object = turtle({ sides = 12, roughness = 0.6 }), interpret = "last" })
cylinder:axiom({ Core() }, Apex())
cylinder:rule("Apex", function()
  local organ = Color(if step() % 8 == 0 then "#c8452f" else "#8fae58")
  return G(rise / 1000), { Down(90), G(radius / 1000), organ, Sphere(size) }, RollRight(divergence), Apex()
end)
cylinder:interpret("Core", function()
  return Color("#5f7a35"), Width(2 * radius / 1000), F(rise / 1000 * organs)
end)

local derived = cylinder:derive(organs)
-- The axis rises by 3.53 mm with each organ. Every eighth organ is red: they are parastichies.
expect(derived.counts.Sphere, 200)
expect(derived.objects[1]:position().z, 200 * 0.00353, 1e-9)
-- The organs are on a helix; the topmost point of each sphere is above its place.
for n = 1, organs do
  local turn = math.rad((n - 1) * divergence)
  local place = vec(-math.sin(turn) * radius, math.cos(turn) * radius, n * rise) / 1000
  expect(derived.objects[1]:distance(place + vec(0, 0, size)), 0, 1e-6)
end

-- Picture: --azimuth 180 --elevation 5
