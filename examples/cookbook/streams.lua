--!strict
-- Towers whose heights stay the same when the windows change: each question has its own stream of random numbers.
local lit = param("lit", { default = 0.35, min = 0, max = 1, doc = "Probability of a lit window" })

local Tower = module("Tower", "x", "y")

local towers = lsystem({ object = extruder({ smooth = false }) })

local places = {}
for x = 0, 4 do
  for y = 0, 3 do
    table.insert(places, { Tower(x * 7, y * 7) })
  end
end
towers:axiom(sequence(places))

towers:interpret("Tower(x, y)", function(this, x, y)
  local heights, windows = stream("heights"), stream("windows")
  local storeys = math.floor(heights(3, 9))
  this:jump({ x, y, 0 }):rectangle(4.4, 4.4):material({ color = "#39424d" }):extrude(storeys * 1.1 + 0.5)
  for storey = 0, storeys - 1 do
    for window = 0, 3 do
      local is_lit = windows() < lit
      local color = if is_lit then "#f3c969" else "#586878"
      this:material({ color = color, emissive = if is_lit then "#8a6a20" else "#000000" })
      this:jump({ x - 1.5 + window, y - 2.25, 0.5 + storey * 1.1 }):rectangle(0.6, 0.1):extrude(0.7)
      this:jump({ x + 2.25, y - 1.5 + window, 0.5 + storey * 1.1 }):rectangle(0.1, 0.6):extrude(0.7)
    end
  end
end)

towers:derive()
