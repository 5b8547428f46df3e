--!strict
-- A rose leaf: each tooth of the edge is a polygon between two veins, and the notches grow at a rate of their own.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 5.8.
local steps = param("steps", { default = 25, min = 3, max = 30, step = 1, doc = "Steps of the derivation" })
local angle =
  param("angle", { default = 60, min = 20, max = 90, unit = "deg", doc = "Between midrib and veins" })
local size = param("size", { default = 1, min = 0.1, max = 10, unit = "m", doc = "Length of the midrib" })
local rib = { length = 5, rate = 1.15 }
local vein = { length = 1.3, rate = 1.25 }
local notch = { length = 3, rate = 1.19 }

-- The midrib has a segment of each step, which has grown in all later ones.
local unit = size * (rib.rate - 1) / (rib.length * (rib.rate ^ steps - 1))

local Apex, Vein = module("Apex", "time", "side"), module("Vein", "potential")
local Part, Notch = module("Part", "length", "rate"), module("Notch", "length", "potential")

local leaf = lsystem({ object = turtle({ color = "#3f7d33", roughness = 0.6 }), interpret = "last" })
leaf:axiom("[{ Apex(0, 1)] { Apex(0, -1)")
-- A polygon begins at the end of a vein, and ends behind the notch at the end of the next vein.
leaf:rule("Apex(t, side)", function(this, t: number, side: number)
  return Point(),
    Part(rib.length, rib.rate),
    Point(),
    { Turn(side * angle), Vein(t), Notch(notch.length, t), Point(), EndPolygon() },
    { Turn(side * angle), Vein(t), BeginPolygon(), Point() },
    Apex(t + 1, side)
end)
leaf:rule("Vein(t)", {
  when = function(this, t)
    return t > 0
  end,
}, function(this, t)
  return Part(vein.length, vein.rate), Vein(t - 1)
end)
leaf:rule("Part(length, rate)", function(this, length: number, rate: number)
  return Part(length * rate, rate)
end)
leaf:rule("Notch(length, t)", {
  when = function(this, length, t)
    return t > 1
  end,
}, function(this, length, t)
  return Notch(length * notch.rate, t - 1)
end)
local function draw(this: any, length: number)
  this:advance(length * unit)
end
leaf:interpret("Part(length, rate)", draw)
leaf:interpret("Notch(length, t)", draw)
-- A small tip closes the last polygon.
leaf:interpret("Apex(t, side)", function(this, t, side: number)
  return Point(), { Turn(side * angle), G(unit), Point() }, { G(2 * unit), Point() }, EndPolygon()
end)

local derived = leaf:derive(steps)
-- A polygon of each step on both sides, along a midrib of the given length.
expect(derived.counts.EndPolygon, 2 * 25)
expect(derived.objects[1]:position().z, 1, 1e-9)

-- Picture: --azimuth 180 --elevation 0
