--!strict
-- Towers from boxes: the rules refine the bounding box of a building into storeys with setbacks, a roof and an antenna, so
-- that each step adds a level of detail.
-- Source: Y. Parish and P. Mueller, Procedural modeling of cities, 2001.
local steps = param("steps", { default = 4, min = 0, max = 6, step = 1, doc = "Levels of detail" })
local setback =
  param("setback", { default = 0.78, min = 0.5, max = 1, doc = "Width of a part by that of the part below" })
local rows = param("rows", { default = 4, min = 1, max = 8, step = 1, doc = "Rows and columns of lots" })

local Mass, Block = module("Mass", "width", "depth", "height"), module("Block", "width", "depth", "height")
local Antenna = module("Antenna", "height")

local lots = {}
for x = 1, rows do
  for y = 1, rows do
    table.insert(lots, { id = `{x}-{y}`, x = 40 * x, y = 40 * y, height = 40 + 70 * random() })
  end
end

local towers = lsystem({ object = extruder({ sides = 4, smooth = false }), interpret = "last" })
towers:axiom(source(lots), function(lot)
  local stone = mix("#c8b89a", "#7f94a8", random())
  return extruder({ position = { lot.x, lot.y, 0 }, smooth = false, color = stone }), Mass(26, 26, lot.height)
end)
towers:rule("Mass(width, depth, height)", {
  when = function(this, width, depth)
    return math.min(width, depth) < 9
  end,
}, function(this, width, depth, height)
  return Antenna(height)
end)
-- A mass becomes a block with a smaller mass on it; a narrow mass ends in an antenna.
towers:rule("Mass(width, depth, height)", { weight = 3 }, function(this, width, depth, height)
  local part = random(0.35, 0.65) * height
  return Block(width, depth, part), Mass(width * setback, depth * setback, height - part)
end)
towers:rule("Mass(width, depth, height)", { weight = 1 }, function(this, width, depth, height)
  local part = random(0.5, 0.8) * height
  local narrow = if random() < 0.5
    then Mass(width * setback, depth * 0.55, height - part)
    else Mass(width * 0.55, depth * setback, height - part)
  return Block(width, depth, part), narrow
end)
local function box(this: any, width: number, depth: number, height: number)
  this:rectangle(width, depth):extrude(height)
end
towers:interpret("Mass(width, depth, height)", box)
towers:interpret("Block(width, depth, height)", box)
towers:interpret("Antenna(height)", function(this, height)
  this:regular(6):scale(0.5):extrude(height)
end)
local city = towers:derive(steps)

-- The parts divide the height of the lot, whatever the weights choose.
for k, tower in city.objects do
  expect(tower:position().z, lots[k].height, 1e-9)
end
expect(#city.objects, 16)
