--!strict
-- Phyllotaxis on a surface of revolution: each primordium takes the area that the surface has for it, at the golden
-- angle from the one before.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Ridley, University of Calgary, after J. N. Ridley, Packing
-- efficiency in sunflower heads, 1982.
local radius =
  param("radius", { default = 0.1, min = 0.04, max = 0.3, unit = "m", doc = "Radius of a primordium" })
local angle =
  param("angle", { default = 137.51, min = 130, max = 145, unit = "deg", doc = "Divergence angle" })
local STEP = 0.001 -- of the integration along the contour (m)

local Apex, Primordium = module("Apex", "arc", "area"), module("Primordium", "arc")

-- The contour is a semicircle of 1 m: the radius and the height of the ring at an arc length.
local LENGTH = math.pi
local function ring(arc: number): (number, number)
  return math.sin(arc), -math.cos(arc)
end

local body = lsystem({ object = turtle({ sides = 10, position = { 0, 0, 1 } }), interpret = "last" })
body:axiom(Apex(0, 0))
body:rule("Apex(arc, area)", function(this, arc, area): any
  while area < radius ^ 2 do
    if arc > LENGTH then
      return nil
    end
    area += 2 * ring(arc) * STEP
    arc += STEP
  end
  return Primordium(arc), Roll(angle), Apex(arc, area - radius ^ 2)
end)
body:interpret("Primordium(arc)", function(this, arc)
  local x, z = ring(arc)
  return Color(mix("#4f7f3a", "#e0b83f", arc / LENGTH)), { G(z), Turn(90), G(x), Sphere(radius) }
end)
local result = body:derive()

-- The sphere has the area 4 pi, and each primordium takes pi r^2.
expect(result.counts.Primordium, 4 / 0.1 ^ 2, 1)
