--!strict
-- An insect climbs a plant, eats the apex of each branch, and comes down again: first left, then right.
-- Source: Virtual Laboratory (cpfg), Signaling/21-insect-schematic, University of Calgary.
local steps = param("steps", { default = 68, min = 0, max = 500, step = 1, doc = "Steps of growth" })
local delay =
  param("delay", { default = 35, min = 0, max = 80, step = 1, unit = "steps", doc = "Arrival of the insect" })
local pause = param(
  "pause",
  { default = 5, min = 1, max = 20, step = 1, unit = "steps", doc = "Rest between internodes" }
)
local LEFT, RIGHT = 3, 5 -- internodes of a branch

local Wait, Apex, Internode = module("Wait", "left"), module("Apex", "rest", "left"), module("Internode")
local Up, Down, Across = module("Up"), module("Down"), module("Across") -- the insect

local function insect(pen: Turtle): any
  local plant = lsystem({ object = pen, interpret = "last" })
  plant:axiom(Wait(delay), Internode(), Apex(0, LEFT))

  plant:rule("Wait(left)", function(this, left: number)
    return if left > 0 then Wait(left - 1) else Up()
  end)
  -- The insect climbs, turns left where the axis forks, and eats the apex.
  plant:rule("Up < Internode", "Internode Up")
  plant:rule("Up < Left", "Left Up")
  plant:rule("Up < Apex", "Down")
  -- On its way down it enters the right branch when it comes out of the left one.
  plant:rule("Internode > [Left Down]", "Internode Across")
  plant:rule("Across < Right", "Right Up")
  plant:rule("Internode > [Left] [Right Down]", "Down Internode")
  plant:rule("Internode > Down", "Down Internode")
  for _, name in { "Up", "Down", "Across" } do
    plant:rule(name, "")
  end

  plant:rule("Internode < Apex(rest, left)", function(this, rest: number, left: number): any
    if rest > 0 then
      return Apex(rest - 1, left)
    elseif left > 0 then
      return Internode(), Apex(pause, left - 1)
    end
    return { Left(), Internode(), Apex(pause, LEFT) }, { Right(), Internode(), Apex(pause, RIGHT) }
  end)
  return plant
end

local plant = insect(turtle({ angle = 45, width = 0.35 }))
plant:interpret("Internode", function()
  return Color("#6a8f4a"), F(1)
end)
plant:interpret("Apex", function()
  return { Color("#3fa34d"), Sphere(0.4) }
end)
for _, name in { "Up", "Down", "Across" } do
  plant:interpret(name, function()
    return { Color("#d8402f"), Sphere(0.7) }
  end)
end
local result = plant:derive(steps)

-- Each turn of the insect moves it by one module, and never copies it. It has not left the plant yet.
expect(result.counts.Up + result.counts.Down + result.counts.Across, 1)

-- The whole visit, without a drawing. An axis gains an internode in every sixth step, and forks in the steps 19, 43 and
-- 55. The insect eats the apices in the steps 48, 54, 73 and 84, when the branches have 1, 2, 3 and 5 internodes.
local visit = insect(nil :: any):derive(120)
expect({ visit.counts.Apex, visit.counts.Internode }, { 0, 2 * (1 + LEFT) + (1 + RIGHT) + 1 + 2 + 3 + 5 })
-- It appears in step 36, and takes a step for each internode on its way up and on its way down, three for each fork, one
-- for each apex, and one to leave the plant.
local forks = visit.counts.Left
expect(visit.counts.Up + visit.counts.Down + visit.counts.Across, 0)
expect(visit.steps, delay + 1 + 2 * visit.counts.Internode + 3 * forks + (forks + 1) + 1)
-- Picture: --azimuth 180 --elevation 0
