--!strict
-- A fern: lateral apices wait before they branch, and internodes grow in proportion to their length.
-- Source: Virtual Laboratory (cpfg), Introduction/07-fractal-ferns, University of Calgary.
local steps = param("steps", { default = 18, min = 0, max = 22, step = 1, doc = "Steps of growth" })
local delay =
  param("delay", { default = 3, min = 0, max = 6, step = 1, unit = "steps", doc = "Rest of an apex" })
local growth = param("growth", { default = 1.28, min = 1, max = 2, doc = "Growth of internodes in a step" })

local Apex, Internode = module("Apex", "age"), module("Internode", "length")

local fern = lsystem({ object = turtle({ angle = 45, width = 1.6 }), interpret = "last" })
fern:axiom(Apex(0))
fern:rule("Apex(age)", function(this, age)
  if age < delay then
    return Apex(age + 1)
  end
  return Internode(1), { Left(), Apex(0) }, { Right(), Apex(0) }, Internode(1), Apex(age)
end)
fern:rule("Internode(length)", function(this, length: number)
  return Internode(length * growth)
end)
fern:interpret("Internode(length)", function(this, length)
  return Color("#4f7a35"), F(length)
end)
fern:interpret("Apex(age)", function(this, age)
  return Color("#7fb850"), F(age)
end)
local plant = fern:derive(steps)

-- The main apex branches in steps 4 to 18, so the axis is two geometric series and the apex, which is 3 long.
expect(plant.objects[1]:position().z, 2 * (1.28 ^ 15 - 1) / 0.28 + 3, 1e-9)
-- The number of apices satisfies a(n) = a(n - 1) + 2 a(n - 4), with a = 1 in the first three steps.
local apices = { 1, 1, 1 }
for n = 4, 18 do
  apices[n] = apices[n - 1] + 2 * (apices[n - 4] or 1)
end
expect(plant.counts.Apex, apices[18])
-- Picture: --azimuth 180 --elevation 0
