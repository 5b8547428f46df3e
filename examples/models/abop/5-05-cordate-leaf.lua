--!strict
-- A cordate leaf: a fan of sectors on each side. In each step a new sector begins next to the last, and all sectors grow.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 5.5.
local steps = param("steps", { default = 20, min = 2, max = 40, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 1, min = 0.1, max = 10, unit = "m", doc = "From the base to the tip" })
local angle = param("angle", { default = 8, min = 2, max = 18, unit = "deg", doc = "Of a sector" })

local Apex, Sector = module("Apex", "side"), module("Sector", "length", "side")
local leaf = lsystem({ object = turtle({ color = "#4a8a3c", roughness = 0.6 }), interpret = "last" })
leaf:axiom({ Roll(-12), Apex(1) }, { Roll(12), Apex(-1) })
leaf:rule("Apex(side)", function(this, side: number)
  return Sector(1, side), Turn(side * angle), Apex(side)
end)
leaf:rule("Sector(length, side)", function(this, length: number, side)
  return Sector(length + 1, side)
end)
-- The far edge of a sector is as long as the near edge of the next.
leaf:interpret("Sector(length, side)", function(this, length: number, side: number)
  local unit = size / steps
  return BeginPolygon(),
    Point(),
    { G(length * unit), Point() },
    { Turn(side * angle), G((length - 0.99) * unit), Point() },
    EndPolygon()
end)

-- A sector of each step on both sides.
expect(leaf:derive(steps).counts.Sector, 2 * 20)

-- Picture: --azimuth 180 --elevation 5
