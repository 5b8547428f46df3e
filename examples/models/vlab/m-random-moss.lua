--!strict
-- A moss: each segment becomes two segments with a branch on one side, or three segments with a branch on both
-- sides, by three rules of the same weight. Branches are thinner and lighter than the segment that bears them.
-- Source: Virtual Laboratory (cpfg), CPFG manual, RandomMoss, University of Calgary.
local steps = param("steps", { default = 5, min = 0, max = 7, step = 1, doc = "Steps of the derivation" })
local plants = param("plants", { default = 6, min = 1, max = 12, step = 1, doc = "Plants in a row" })
local angle = param("angle", { default = 27, min = 5, max = 60, unit = "deg", doc = "Of the branches" })

local Segment = module("Segment", "order")
local COLORS = ramp({ { 0, 0 }, { 4, 1 } })

local row: { any } = {}
for k = 1, plants do
  row[k] = { id = `plant {k}`, x = 28 * k }
end
local moss = lsystem({ object = turtle, interpret = "last" })
moss:axiom(source(row), function(plant)
  return turtle({ position = { plant.x, 0, 0 }, sides = 4 }), Segment(0)
end)
for _, sides in { { angle, -angle }, { angle }, { -angle } } do
  moss:rule("Segment(order)", { weight = 1 }, function(this, order)
    local list: { any } = { Segment(order) }
    for _, side in sides do
      table.insert(list, { Turn(side), Segment(order + 1) })
      table.insert(list, Segment(order))
    end
    return sequence(list)
  end)
end
moss:interpret("Segment(order)", function(this, order)
  this:color(mix("#3f5f2f", "#a8b84a", COLORS:at(order))):width(1.6 * 0.6 ^ order):forward(1)
end)
local result = moss:derive(steps)

-- A stem is straight, and its segments become two or three in each step.
for k, pen in result.objects do
  local top = pen:position()
  expect(top:distance(vec(28 * k, 0, top.z)), 0, 1e-9)
  expect(top.z >= 2 ^ 5 and top.z <= 3 ^ 5, true)
end
-- A segment becomes five segments or, in two of three cases, three: 11/3 on average.
expect(result.counts.Segment, 6 * (11 / 3) ^ 5, 6 * (11 / 3) ^ 5 / 3)
-- Picture: --azimuth 180 --elevation 0
