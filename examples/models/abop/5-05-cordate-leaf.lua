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
leaf:rule("Sector(length, side)", "Sector(length + 1, side)")
-- The far edge of a sector is as long as the near edge of the next.
leaf:interpret("Sector(length, side)", function(this, length: number, side: number)
  local unit = size / steps
  return BeginPolygon(),
    Point(),
    { G(length * unit), Point() },
    { Turn(side * angle), G((length - 0.99) * unit), Point() },
    EndPolygon()
end)

local derived = leaf:derive(steps)
-- A sector of each step on both sides, each a twentieth shorter than the one before it.
expect(derived.counts.Sector, 2 * 20)
local halves: { string } = {}
for side = 1, -1, -2 do
  local half = ""
  for length = steps, 1, -1 do
    half ..= `Sector({length},{side}) Turn({side * angle}) `
  end
  table.insert(halves, `[ Roll({-12 * side}) {half}Apex({side}) ]`)
end
expect(derived.chains[1], table.concat(halves, " "))
-- So the corners of the outline are on a spiral of Archimedes, r = 1 - t / 160 degrees. Each half has a plane of its own,
-- at 12 degrees to the picture. A place 5 % farther out is outside of the leaf.
for k = 0, steps // 2 do
  local turn, r = math.rad(k * angle), size * (1 - k / steps)
  for side = -1, 1, 2 do
    local aside = vec(-side * math.cos(math.rad(12)), -math.sin(math.rad(12)), 0)
    local corner = (aside * math.sin(turn) + vec(0, 0, 1) * math.cos(turn)) * r
    expect(derived.objects[1]:distance(corner), 0, 1e-6)
    expect(derived.objects[1]:distance(corner * 1.05) > 0.04 * r, true)
  end
end

-- Picture: --azimuth 180 --elevation 5
