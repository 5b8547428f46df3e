--!strict
-- Blocks of a city under a zoning law: lots by area, envelopes that step back from the street, and towers that fill them.
local height =
  param("height", { default = 46, min = 10, max = 120, unit = "m", doc = "Greatest height of an envelope." })
local street_wall = param(
  "street_wall",
  { default = 18, min = 3, max = 60, unit = "m", doc = "Height of the wall along a street." }
)
local angle = param(
  "angle",
  { default = 68, min = 20, max = 89, unit = "deg", doc = "Slope of the envelope above the wall." }
)

local District, Block, Lot, Tower =
  module("District", "plan"), module("Block", "plan"), module("Lot", "plan"), module("Tower", "mass")
local city = lsystem({ object = extruder() })
local COLORS = { "#c9b79a", "#b8a488", "#d6cbb8", "#a8a29a", "#bfa58c" }

city:axiom(District(rectangle(330, 240)))
-- Streets of two widths between the blocks.
city:rule("District(plan)", function(this, plan: Shape)
  local parts: { any } = { Draw(plan:extrude(-0.4):color("#6e7276")) }
  for _, column in plan:split("x", { { "~66", 16 }, "~66" }) do
    if column:entry() ~= 2 then
      for _, block in column:split("y", { { "~90", 12 }, "~90" }) do
        if block:entry() ~= 2 then
          table.insert(parts, Block(block))
        end
      end
    end
  end
  return sequence(parts)
end)
-- A pavement, and two rows of lots.
city:rule("Block(plan)", function(this, plan: Shape)
  local parts: { any } = { Draw(plan:extrude(0.15):color("#a9a9a4")) }
  local inner = plan:setback(3)[1]
  for _, row in inner:split("x", { "~1", "~1" }) do
    for _, lot in row:split_area("y", { "~620*" }) do
      table.insert(parts, Lot(lot))
    end
  end
  return sequence(parts)
end)
-- The envelope of a lot, and in it a mass of one to three steps.
city:rule("Lot(plan)", function(this, plan: Shape)
  local limits = { left = { street_wall, angle }, right = { street_wall, angle } }
  local most = height * (0.45 + 0.55 * random())
  local envelope = plan:translate(vec(0, 0, 0.15)):envelope(most, limits)
  return Tower(envelope:color(COLORS[math.floor(random() * 5) + 1]))
end)
-- Storeys, with a dark band of windows below each floor.
city:rule("Tower(mass)", function(this, mass: Shape)
  local parts: { any } = {}
  for _, part in mass:split("z", { 4.2, { 0.9, "~2.4" }, 0.9 }) do
    local sides = part:joined_faces("side")
    if part:entry() == 3 and sides then
      table.insert(parts, Draw(sides:color("#46545f")))
    elseif part:entry() == 1 and sides then
      table.insert(parts, Draw(sides:color("#5a554c")))
    else
      table.insert(parts, Draw(part))
    end
  end
  return sequence(parts)
end)
city:derive()

camera({ from = vec(-86, -140, 120), to = vec(150, 100, 0), fov = 42 })
