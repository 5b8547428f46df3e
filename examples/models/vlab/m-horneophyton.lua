--!strict
-- Horneophyton, an early land plant: its axes fork in perpendicular planes, and steeper axes grow longer.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Horneophyton, University of Calgary.
local forks = param("forks", { default = 7, min = 0, max = 9, step = 1, doc = "Number of forks of an axis" })
local angle =
  param("angle", { default = 20, min = 5, max = 45, unit = "deg", doc = "Of a branch to its parent" })
local shorter =
  param("shorter", { default = 0.95, min = 0.5, max = 1, doc = "Length of a branch by its parent" })
local thinner =
  param("thinner", { default = 0.85, min = 0.5, max = 1, doc = "Width of a branch by its parent" })
local response =
  param("response", { default = 1, min = 0, max = 3, doc = "Response of the length to the direction" })

local Apex, Sporangium = module("Apex", "length", "width"), module("Sporangium", "width")

local plant = lsystem({ object = turtle({ color = "#6f8f3f", width = 1.5 }) })
plant:axiom(Roll(-30), Apex(10, 1.5))
plant:rule("Apex(l, w)", function(this, l: number, w: number)
  if step() > forks then
    return Sporangium(w)
  end
  local child = Apex(l * shorter * math.max(this:heading().z, 0) ^ response, w * thinner)
  return Width(w * thinner), F(l), { Right(angle), Roll(-90), child }, { Left(angle), Roll(-90), child }
end)
plant:interpret("Sporangium(w)", function(this, w)
  return Color("#a8542f"), F(3), Sphere(w / 2)
end)
local result = plant:derive(forks + 1)

-- Each of the seven forks doubles the number of axes.
expect(result.counts.Sporangium, 2 ^ 7)
expect(result.counts.F, 2 ^ 7 - 1)
