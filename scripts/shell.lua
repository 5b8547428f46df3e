--!strict
-- A sea shell. The animal adds segments at the mouth, each a little larger than the last, with the same bend, the
-- same twist and the same ratio. This alone forms the spiral.
local pieces =
  param("pieces", { default = 144, min = 10, max = 300, step = 1, doc = "Pieces that have been added" })
local growth =
  param("growth", { default = 1.025, min = 1.005, max = 1.06, doc = "Size of a piece by the one before" })
local bend = param("bend", { default = 17.5, min = 5, max = 30, unit = "deg", doc = "Bend of a piece" })
local twist = param(
  "twist",
  { default = 4.8, min = -10, max = 10, unit = "deg", doc = "Twist, which draws the spiral out" }
)
local ribs = param("ribs", { default = 9, min = 0, max = 24, step = 1, doc = "Ribs along the tube" })
local light = param("light", { default = "#f6e7d0", doc = "Colour of the shell" })
local dark = param("dark", { default = "#b4593a", doc = "Colour of its bands" })

local Facing = module("Facing", "angle")
local Mouth = module("Mouth", "n", "radius")
local Piece = module("Piece", "n", "radius")
local Lip = module("Lip", "radius")

-- A tube with ribs outside and a smooth wall inside.
local outside, inside = {}, {}
for k = 0, 95 do
  local angle = k / 96 * 2 * math.pi
  local x, y = math.cos(angle), math.sin(angle)
  local r = 1 + 0.035 * math.cos(ribs * angle)
  table.insert(outside, { r * x, r * y })
  table.insert(inside, 1, { 0.9 * x, 0.9 * y })
end

local shell =
  lsystem({ object = extruder({ heading = { 0, 1, 0 }, along = 2, roughness = 0.35 }), interpret = "last" })

shell:axiom(Facing(325), Mouth(0, 0.004))

shell:rule("Mouth(n, r)", function(this, n, r)
  if n == pieces then
    return Lip(r)
  end
  return Piece(n, r), Mouth(n + 1, r * growth)
end)

local LENGTH = 0.36 -- of a segment, relative to its radius

shell:interpret("Facing(angle)", function(this, angle)
  this:turn(angle)
end)
shell:interpret("Piece(n, r)", function(this, n, r)
  local band = ease.smooth(math.abs(2 * (n / 10 % 1) - 1))
  this:bend(bend, 0):twist(twist)
  this:polygon(outside, { inside })
  this:color(mix(light, dark, math.floor(band * 8) / 8))
  this:scale(r):taper(r * growth):extrude(r * LENGTH)
end)

-- The lip flares.
shell:interpret("Lip(r)", function(this, r)
  for _ = 1, 4 do
    r *= 1.06
    this:bend(bend * 0.35, 0):color(light)
    this:taper(r):extrude(r * 0.14)
  end
end)

shell:derive()
