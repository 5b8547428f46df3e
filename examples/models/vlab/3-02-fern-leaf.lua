--!strict
-- A fern leaf by positional information: the distance from the base says how long, wide and bent each part is.
-- Source: Virtual Laboratory (cpfg), inverse-modeling/02-fern-leaf, University of Calgary, after P. Prusinkiewicz,
-- L. Mundermann, R. Karwowski and B. Lane, The use of positional information in the modeling of plants, 2001.
local internode =
  param("internode", { default = 0.06, min = 0.02, max = 0.2, doc = "Internode by the length above it" })
local finish = param("finish", { default = 0.98, min = 0.5, max = 0.999, doc = "Place of the last leaflets" })
local leaflet =
  param("leaflet", { default = 0.3, min = 0.05, max = 0.6, doc = "Length of the longest leaflet" })
local curl =
  param("curl", { default = 130, min = 0, max = 720, unit = "deg", doc = "Bending of the whole axis" })

local Axis, Leaflet = module("Axis", "x"), module("Leaflet", "x")

-- The functions of the place x, from 0 at the base to 1 at the tip.
local function leaflet_length(x: number): number
  return leaflet * math.sin(math.pi * (0.08 + 0.92 * x) ^ 0.6)
end
local function leaflet_angle(x: number): number
  return lerp(85, 35, x)
end

local leaf = lsystem({ object = turtle({ color = "#5f7f35", sides = 5 }), interpret = "last" })
leaf:axiom(Axis(0))
leaf:decompose("Axis(x)", {
  when = function(this, x)
    return x < finish
  end,
}, function(this, x)
  local next = x + internode * (1 - x)
  return Pitch(curl * (next ^ 2 - x ^ 2)),
    Width(0.015 * (1 - x) + 0.002),
    F(next - x),
    { Turn(leaflet_angle(next)), Leaflet(next) },
    { Turn(-leaflet_angle(next)), Leaflet(next) },
    Axis(next)
end)
leaf:interpret("Leaflet(x)", function(this, x)
  local length = leaflet_length(x)
  return Color(mix("#3f7a35", "#8fbf4a", x)),
    Pitch(15),
    BeginPolygon(),
    Point(),
    { Turn(9), G(length * 0.5), Point() },
    { G(length), Point() },
    { Turn(-9), G(length * 0.5), Point() },
    EndPolygon()
end)
local result = leaf:derive(0)

-- Each internode leaves 94 % of the length above it: 64 pairs until less than 2 % are left.
local pairs_of_leaflets = math.ceil(math.log(0.02) / math.log(0.94))
expect(result.counts.Leaflet, 2 * pairs_of_leaflets)
-- Picture: --azimuth 215 --elevation 15
