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

local plant = lsystem({ object = turtle({ angle = 45, width = 0.35 }), interpret = "last" })
plant:axiom(Wait(delay), Internode(), Apex(0, LEFT))

plant:rule("Wait(left)", function(this, left)
  return if left > 0 then Wait(left - 1) else Up()
end)

-- The insect climbs, turns left where the axis forks, and eats the apex.
plant:rule("Up < Internode", function()
  return Internode(), Up()
end)
plant:rule("Up < Left", function()
  return Left(), Up()
end)
plant:rule("Up < Apex", function()
  return Down()
end)
-- On its way down it enters the right branch when it comes out of the left one.
plant:rule("Internode > [Left Down]", function()
  return Internode(), Across()
end)
plant:rule("Across < Right", function()
  return Right(), Up()
end)
plant:rule("Internode > [Left] [Right Down]", function()
  return Down(), Internode()
end)
plant:rule("Internode > Down", function()
  return Down(), Internode()
end)
for _, name in { "Up", "Down", "Across" } do
  plant:rule(name, function()
    return nil
  end)
end

plant:rule("Internode < Apex(rest, left)", function(this, rest, left)
  if rest > 0 then
    return Apex(rest - 1, left)
  elseif left > 0 then
    return Internode(), Apex(pause, left - 1)
  end
  return { Left(), Internode(), Apex(pause, LEFT) }, { Right(), Internode(), Apex(pause, RIGHT) }
end)

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
-- Picture: --azimuth 180 --elevation 0
