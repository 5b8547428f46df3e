--!strict
-- A town's streets and nothing else: main streets that wander out of the middle, side streets that leave them at right
-- angles, and dead ends that are joined where that saves a detour. Rules say where streets want to go; the network says
-- what becomes of them, and keeps their distances, angles and corners.

local steps = param("steps", { default = 16, min = 1, max = 60, step = 1 })
local pattern = param("pattern", { default = "organic", choices = { "organic", "raster", "radial" } })
local block = param("block", { default = 85, min = 40, max = 200, unit = "m" })
local bends = param("bends", { default = 14, min = 0, max = 40, unit = "deg" })
local branching = param("branching", { default = 0.55, min = 0, max = 1 })

-- A street grows at a tip: from a junction, towards a heading, and how often its way has branched off.
local Tip = module("Tip", "junction", "heading", "depth")
-- Where a side street may leave.
local Bud = module("Bud", "junction", "heading", "depth")
-- Counts the steps, and tidies up after the last.
local Clock = module("Clock", "left")

local roads = lsystem({
  object = network({
    streets = {
      { width = 27, lanes = 4, median = 3, sidewalk = 4.5 },
      { width = 17, lanes = 2, parking = 2.2, sidewalk = 3 },
      { width = 11, lanes = 2, sidewalk = 2 },
    },
    snap = block * 0.35,
    min_angle = 50,
    ground = "#66774e",
  }),
})

roads:axiom(Tip(1, 8, 0), Tip(1, 98, 0), Tip(1, 188, 0), Tip(1, 278, 0), Clock(steps))

-- Where a street goes on to, by the pattern of the town.
local function onward(this: Network, junction: number, heading: number): number
  if pattern == "raster" then
    return heading
  elseif pattern == "radial" then
    -- A street keeps to its ray, or to its ring around the middle.
    local x, y = this:place(junction)[1], this:place(junction)[2]
    local ray = math.deg(math.atan2(y, x))
    local turns = math.floor((heading - ray) / 90 + 0.5)
    return if x == 0 and y == 0 then heading else ray + 90 * turns
  end
  return heading + random(-bends, bends)
end

roads:rule("Tip(junction, heading, depth)", function(this, junction: number, heading: number, depth: number)
  local at = this:reached(junction, heading)
  if not at then
    return nil
  end
  local on = onward(this, at, heading)
  return Tip(at, on, depth), Bud(at, on + 90, depth + 1), Bud(at, on - 90, depth + 1)
end)

roads:rule("Bud(junction, heading, depth)", { weight = branching }, function(this, junction, heading, depth)
  return Tip(junction, heading, depth)
end)

roads:rule("Bud", { weight = 1 - branching }, function()
  return nil
end)

roads:rule("Clock(left)", {
  when = function(this, left)
    return left > 0
  end,
}, function(this, left)
  return Clock(left - 1)
end)

roads:interpret(
  "Tip(junction, heading, depth)",
  function(this, junction: number, heading: number, depth: number)
    this:grow(junction, heading, if depth == 0 then block * 1.25 else block, depth)
  end
)

roads:interpret("Clock(left)", function(this, left)
  if left == 0 then
    this:join_dead_ends(block * 1.6, 2):remove_dead_ends()
  end
end)

roads:derive(steps)
