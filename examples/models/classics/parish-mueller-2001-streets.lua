--!strict
-- Streets of a raster with local constraints: roads grow block by block. A road that meets water crosses it on a bridge
-- if the other bank is near, and otherwise ends at the bank.
-- Source: Y. Parish and P. Mueller, Procedural modeling of cities, 2001.
local blocks =
  param("blocks", { default = 14, min = 2, max = 24, step = 1, doc = "Blocks of a side of the town" })
local block = param("block", { default = 80, min = 40, max = 200, unit = "m", doc = "Edge of a block" })
local bridge =
  param("bridge", { default = 2, min = 0, max = 6, step = 1, doc = "Blocks of the longest bridge" })

local Road, Bridge = module("Road", "left", "spawns"), module("Bridge", "length")
local Shore = module("Shore")

-- A river and a lake.
local function is_water(place: any): boolean
  local x, y = place.x / block, place.y / block
  return math.abs(y - 4.5 - 1.5 * math.sin(x / 2)) < 0.6 or (x - 10) ^ 2 + (y - 10.5) ^ 2 < 6
end

-- The number of blocks to the next place on land, if it is near enough.
local function to_land(place: any, heading: any): number?
  for k = 1, bridge + 1 do
    if not is_water(place + heading * (k * block)) then
      return k
    end
  end
  return nil
end

-- The roads along the edges of the town have the streets at their blocks: `spawns` is the angle to them, or 0.
local town = lsystem({ object = turtle({ heading = { 1, 0, 0 }, width = 12, sides = 4, color = "#5a5a60" }) })
town:axiom(Roll(90), { Road(blocks, 90) }, { Turn(90), Road(blocks, -90) })
town:rule("Road(left, spawns)", function(this, left, spawns): any
  local k = to_land(this:position(), this:heading())
  if not k then
    return Shore()
  elseif k > left then
    return nil
  end
  local way = if k == 1 then F(block) else Bridge(k * block)
  if spawns == 0 then
    return way, Road(left - k, 0)
  end
  return way, { Turn(spawns), Road(blocks, 0) }, Road(left - k, spawns)
end)
town:interpret("Bridge(length)", function(this, length)
  return { Color("#c0562f"), F(length) }, G(length)
end)
town:interpret("Shore", function()
  return { Color("#3f7fb0"), Sphere(14) }
end)
local streets = town:derive()

-- The water, as a map of squares.
local Water = module("Water", "x", "y")
local map = lsystem({ object = turtle({ color = "#8fb8d8" }) })
local squares: any = {}
for x = 0, blocks, 0.5 do
  for y = 0, blocks, 0.5 do
    if is_water(vec(x, y, 0) * block) then
      table.insert(squares, Water(x, y))
    end
  end
end
map:axiom(table.unpack(squares))
map:interpret("Water(x, y)", function(this, x, y)
  this:begin_polygon()
  for _, corner in { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } } do
    this:jump(vec(x + corner[1] / 4, y + corner[2] / 4, 0) * block - vec(0, 0, 8)):point()
  end
  this:end_polygon()
end)
map:derive(0)

-- The same count, line by line, without rules.
local function count(x: number, y: number, dx: number, dy: number, spawns: boolean): (number, number)
  local roads, bridges, left = 0, 0, blocks
  while true do
    local k = to_land(vec(x, y, 0) * block, vec(dx, dy, 0))
    if not k or k > left then
      return roads, bridges
    end
    if k == 1 then
      roads += 1
    else
      bridges += 1
    end
    x, y, left = x + k * dx, y + k * dy, left - k
    if spawns then
      local more, across = count(x, y, dy, dx, false)
      roads, bridges = roads + more, bridges + across
    end
  end
end
local roads, bridges = count(0, 0, 1, 0, true)
local more, across = count(0, 0, 0, 1, true)
expect(streets.counts.F, roads + more)
expect(streets.counts.Bridge, bridges + across)
-- Picture: --azimuth 200 --elevation 60
