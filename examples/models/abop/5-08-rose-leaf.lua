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

-- A tooth begins at time t. Its upper vein makes a segment in each of the next t steps.
local Apex, Tooth = module("Apex", "time", "side"), module("Tooth", "time", "age", "side")
local function vein_length(t: number, age: number): number
  local length = 0
  for n = 1, math.min(t, age) do
    length += vein.length * vein.rate ^ (age - n)
  end
  return length * unit
end

local leaf = lsystem({ object = turtle({ color = "#3f7d33", roughness = 0.6 }), interpret = "last" })
leaf:axiom({ Apex(0, 1) }, Apex(0, -1))
leaf:rule("Apex(t, side)", function(this, t: number, side)
  return Tooth(t, 0, side), Apex(t + 1, side)
end)
leaf:rule("Tooth(t, age, side)", function(this, t, age: number, side)
  return Tooth(t, age + 1, side)
end)
-- The vein of the tooth below is one step older.
leaf:interpret("Tooth(t, age, side)", function(this, t: number, age: number, side: number)
  local point = notch.length * notch.rate ^ math.clamp(t - 1, 0, age) * unit
  return BeginPolygon(),
    { Turn(side * angle), G(vein_length(t - 1, age + 1)), Point() },
    Point(),
    G(rib.length * rib.rate ^ age * unit),
    Point(),
    { Turn(side * angle), G(vein_length(t, age) + point), Point() },
    EndPolygon()
end)

local derived = leaf:derive(steps)
-- A tooth of each step on both sides, along a midrib of the given length.
expect(derived.counts.Tooth, 2 * 25)
expect(derived.objects[1]:position().z, 1, 1e-9)

-- Picture: --azimuth 180 --elevation 0
