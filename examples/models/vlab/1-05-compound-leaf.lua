--!strict
-- A compound leaf: rules replace apices and internodes, and interpretations draw both as segments.
-- Source: Virtual Laboratory (cpfg), Introduction/05-compound-homo, University of Calgary.
local steps = param("steps", { default = 5, min = 0, max = 8, step = 1, doc = "Steps of growth" })
local angle = param("angle", { default = 45, min = 10, max = 80, unit = "deg", doc = "Branching angle" })

local Apex, Internode = module("Apex"), module("Internode")

local leaf = lsystem({ object = turtle({ angle = angle, width = 0.5 }), interpret = "last" })
leaf:axiom(Apex())
leaf:rule("Apex", function()
  return Internode(), { Left(), Apex() }, { Right(), Apex() }, Internode(), Apex()
end)
leaf:rule("Internode", function()
  return Internode(), Internode()
end)
leaf:interpret("Internode", function()
  return Color("#5f7f35"), F(1)
end)
leaf:interpret("Apex", function()
  return Color("#3fa34d"), F(1)
end)
local plant = leaf:derive(steps)

-- The number of apices triples. Internodes double, and each apex adds two: 2 (3^n - 2^n) after n steps.
expect(plant.counts.Apex, 3 ^ 5)
expect(plant.counts.Internode, 2 * (3 ^ 5 - 2 ^ 5))
-- The length of the main axis satisfies l(n + 1) = 2 l(n) + 1.
expect(plant.objects[1]:position().z, 2 ^ 6 - 1, 1e-9)
-- Picture: --azimuth 180 --elevation 0
