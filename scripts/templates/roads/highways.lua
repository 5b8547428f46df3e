--!strict
-- Highways: main streets that join the centres of towns before the towns grow.
local checks = require("checks")

local highways = {}

local between = checks.between

-- A highway on its way to the start with this number.
local Highway = module("Highway", "junction", "heading", "length", "goal", "tries", "left")
-- The last part of a highway. If all attempts are refused, it is led to its goal, and the network reports a failure.
local Arrival = module("Arrival", "junction", "heading", "length", "goal", "tries")

-- The turns (degrees) of a refused main street, one attempt after the other.
highways.ASIDE = { 20, -40, 55, -70 }
-- The turns for the last part of a highway, which can join any street of the town.
local ASTRAY = { 20, -40, 60, -80, 100, -120, 140, -160 }
-- The length (m) of a highway from junction to junction.
local LENGTH = 90

-- The pairs of centres that highways join: pairs whose circle contains no third centre.
local function joined(centres: { { number } }): { { number } }
  local pairs = {}
  for a = 1, #centres do
    for b = a + 1, #centres do
      local x, y = (centres[a][1] + centres[b][1]) / 2, (centres[a][2] + centres[b][2]) / 2
      local reach = (centres[a][1] - x) ^ 2 + (centres[a][2] - y) ^ 2
      local is_free = true
      for c, other in centres do
        if c ~= a and c ~= b and (other[1] - x) ^ 2 + (other[2] - y) ^ 2 < reach then
          is_free = false
        end
      end
      if is_free then
        table.insert(pairs, { a, b })
      end
    end
  end
  return pairs
end

-- The modules of the highways that join centres within a number of steps; errors name `caller`, `level` functions
-- above.
function highways.axiom(centres: { { number } }, steps: number, caller: string, level: number): { any }
  local modules = {}
  for _, pair in joined(centres) do
    local from, to = centres[pair[1]], centres[pair[2]]
    local east, north = to[1] - from[1], to[2] - from[2]
    local far = math.sqrt(east * east + north * north)
    local least = math.ceil(far / LENGTH) + 1
    if least > steps then
      error(
        `{caller}: the highway from centre {pair[1]} to centre {pair[2]}, {math.round(far)} m, takes {least} steps or more, and there are {steps}; give more, or centres that are nearer`,
        level
      )
    end
    table.insert(modules, Highway(pair[1], math.deg(math.atan2(north, east)), LENGTH, pair[2], 0, steps))
  end
  return modules
end

-- The rules of highways. `side` returns the module of a street that leaves a highway, if it is `inside` the town.
function highways.rules(
  system: System<Network>,
  side: (junction: number, heading: number, wait: number, left: number) -> any,
  inside: (x: number, y: number) -> boolean
)
  system:rule(
    "Highway(junction, heading, length, goal, tries, left)",
    function(
      this: Network,
      junction: number,
      heading: number,
      length: number,
      goal: number,
      tries: number,
      left: number
    )
      local at = this:end_junction(junction, heading)
      if not at then
        return if tries < #highways.ASIDE
          then Highway(junction, heading + highways.ASIDE[tries + 1], length, goal, tries + 1, left - 1)
          else Arrival(junction, heading, length, goal, #ASTRAY + 1)
      elseif at == goal then
        return nil
      end
      local here, there = this:place(at), this:place(goal)
      local rest = here:distance(there)
      local straight = math.deg(math.atan2(there.y - here.y, there.x - here.x))
      if rest < 1.6 * length then
        return Arrival(at, straight, rest, goal, 0)
      end
      -- A highway winds slightly, and turns no more than necessary.
      local swing = 12 * noise(here.x / 300, here.y / 300)
      local turn = math.clamp(between(heading, straight + swing), -20, 20)
      local modules = { Highway(at, heading + turn, length, goal, 0, left - 1) }
      if inside(here.x, here.y) and random() < 0.6 then
        local first = if random() < 0.5 then 90 else -90
        table.insert(modules, side(at, heading + first, 3, left - 1))
      end
      return table.unpack(modules)
    end
  )

  system:rule(
    "Arrival(junction, heading, length, goal, tries)",
    function(this: Network, junction: number, heading: number, length: number, goal: number, tries: number)
      if this:end_junction(junction, heading) or tries > #ASTRAY then
        return nil
      end
      return Arrival(junction, heading + (ASTRAY[tries + 1] or 0), length, goal, tries + 1)
    end
  )

  system:interpret(
    "Highway(junction, heading, length, goal, tries, left)",
    function(this: Network, junction: number, heading: number, length: number)
      this:grow(junction, heading, length, 0)
    end
  )
  system:interpret(
    "Arrival(junction, heading, length, goal, tries)",
    function(this: Network, junction: number, heading: number, length: number, goal: number, tries: number)
      if tries > #ASTRAY then
        this:grow_to(junction, this:place(goal), 0)
      else
        this:grow(junction, heading, length, 0)
      end
    end
  )
end

return highways
