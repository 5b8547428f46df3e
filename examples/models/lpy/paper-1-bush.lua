--!strict
-- The first example of the paper on L-Py: a bush whose internodes thicken with age.
-- Source: F. Boudon, C. Pradal, T. Cokelaer, P. Prusinkiewicz and C. Godin, L-Py: an L-system simulation framework for
-- modeling plant architecture development based on a dynamic language, 2012, L-system 1.
local steps = param("steps", { default = 6, min = 0, max = 10, step = 1, doc = "Steps of growth" })
local thickening =
  param("thickening", { default = 0.04, min = 0, max = 0.2, unit = "m", doc = "Of an internode in a step" })
local angle =
  param("angle", { default = 40, min = 10, max = 80, unit = "deg", doc = "Angle of the branches" })
local MAX_AGE = 10

local Apex, Internode = module("Apex", "age"), module("Internode", "length", "width")

local bush = lsystem({ object = turtle({ color = "#7a5a3a", width = 0.4 }), interpret = "last" })
bush:axiom(Apex(0))
bush:rule("Internode(l, w)", function(this, l: number, w: number)
  return Internode(l, w + thickening)
end)
bush:rule("Apex(age)", {
  when = function(this, age)
    return age < MAX_AGE
  end,
}, function(this, age)
  return Internode(1, 0.1), RollRight(137.5), { Turn(angle), Apex(age + 1) }, Apex(age + 1)
end)
bush:interpret("Internode(l, w)", function(this, l, w)
  return Width(w), F(l)
end)
bush:interpret("Apex", function()
  return Color("#5f9a3f"), Sphere(0.18)
end)
local result = bush:derive(steps)

-- Apices double, and each step adds an internode per apex. The first internode has thickened in five steps.
expect(result.counts.Apex, 2 ^ 6)
expect(result.counts.Internode, 2 ^ 6 - 1)
expect(tonumber(result.chains[1]:match("^Internode%(1,([%d.]+)%)")), 0.1 + 5 * 0.04, 1e-9)
