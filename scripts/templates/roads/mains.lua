--!strict
-- Main streets of a town around one centre: they lead from there to the outline of the town, and a street along the outline
-- joins their ends, so that all land within lies between streets.
local checks = require("checks")
local ways = require("ways")

local mains = {}

type Pattern = any

-- A main street on its way out: the bearing (degrees) from the centre that it keeps to, and the angle (degrees) that it has to
-- itself.
local Spoke = module("Spoke", "junction", "heading", "length", "bearing", "room", "tries")
-- Joins the ends of main streets along the outline.
local Outline = module("Outline")
-- A street along the outline by places (m), from one main street to another; both would lead on with headings (degrees).
local Rim = module("Rim", "junction", "way", "leads", "is_end", "goal", "meets", "tries")
-- Removes streets that lead nowhere.
local Trim = module("Trim")

mains.Outline, mains.Trim = Outline, Trim
mains.GROWING = {
  "Spoke(junction, heading, length, bearing, room, tries)",
  "Outline",
  "Rim(junction, way, leads, is_end, goal, meets, tries)",
  "Trim",
}

-- How far (degrees) a main street turns when it is refused, one try after the other.
local ASIDE = { 20, -40, 60, -80 }
-- How far (degrees) it turns from one piece to the next.
local MOST = 18
-- How often the outline is tried between two main streets.
local TRIES = 6
-- How long (m) a piece of the outline is about, and how far it swings, as a share of its length between two main streets.
local PIECE, SWING = 52, 0.12
-- How much nearer (m) to the centre each further try ends.
local BEFORE = 22
-- How far (degrees) the outline turns at most from a main street that would lead on.
local STEEP = 112
-- For how many bearings the outline is computed.
local BEARINGS = 120
-- How far the outline lies from the border of the land, as shares of the distance of the border from the centre.
local NEAREST, FARTHEST = 0.62, 0.97
-- How wide the land beside a main street is about when it forks, (m).
local WIDE = 460
-- How many main streets leave the centre, and the least angle (degrees) between two.
local COUNT, APART = { 3, 6 }, 54

-- The distance (m) of the outline from a centre by the bearing (degrees), for land that `inside` describes.
local function outline(
  inside: (x: number, y: number) -> boolean,
  centre: { number }
): (bearing: number) -> number
  local field = math.floor(random() * 1000000)
  local long, turned = random(0, 0.14), random(0, 180)
  local distances = {}
  for index = 0, BEARINGS - 1 do
    local bearing = math.rad(index * 360 / BEARINGS)
    local east, north = math.cos(bearing), math.sin(bearing)
    local far, step: number = 0, 64
    while step >= 2 and far < 20000 do
      if inside(centre[1] + (far + step) * east, centre[2] + (far + step) * north) then
        far += step
      else
        step /= 2
      end
    end
    local share = 0.83
      - long * math.cos(2 * (bearing - math.rad(turned)))
      + 0.22 * noise(0.9 * east, 0.9 * north, 0.5, field)
      + 0.07 * noise(3 * east, 3 * north, 4.5, field)
    distances[index] = far * math.clamp(share, NEAREST, FARTHEST)
  end
  return function(bearing: number): number
    local at = bearing % 360 / 360 * BEARINGS
    local index = math.floor(at)
    local low, high = distances[index % BEARINGS], distances[(index + 1) % BEARINGS]
    return low + (at - index) * (high - low)
  end
end

-- The headings (degrees) of main streets that leave a centre where none are given.
function mains.headings(): { number }
  local count, turned = math.floor(random(COUNT[1], COUNT[2] + 1)), random(0, 360)
  local uneven = math.min(0.5 * (360 / count - APART), 20)
  local headings = {}
  for index = 1, count do
    table.insert(headings, turned + index * 360 / count + random(-uneven, uneven))
  end
  return headings
end

-- The rules of main streets around a centre; `propose` proposes a street.
function mains.rules(
  system: System<Network>,
  pattern: Pattern,
  inside: (x: number, y: number) -> boolean,
  centre: { number },
  propose: ways.Propose
)
  local rim = outline(inside, centre)
  local field = math.floor(random() * 1000000)
  local piece = pattern.length(centre[1], centre[2], 0, 0)

  local function polar(place: Vector): (number, number)
    local dx, dy = place.x - centre[1], place.y - centre[2]
    return math.sqrt(dx * dx + dy * dy), math.deg(math.atan2(dy, dx))
  end
  local function place_at(far: number, bearing: number): (number, number)
    return centre[1] + far * math.cos(math.rad(bearing)), centre[2] + far * math.sin(math.rad(bearing))
  end

  -- The next piece of a main street; nil at the outline.
  local function onward(place: Vector, at: number, heading: number, bearing: number, room: number): any
    local far, now = polar(place)
    local rest = rim(if far < 1 then bearing else now) - far
    if rest < 0.5 * piece then
      return nil
    end
    local length = if rest < 1.5 * piece then rest else piece
    -- It swings between the centre and the outline, which it meets about square.
    local swing = (pattern.bow or 0) * 60 * noise(far / (4.5 * piece), bearing / 40, 2.5, field)
    swing *= math.min(1, far / (5 * piece), rest / (6 * piece))
    local x, y = place_at(far + 1.4 * length, (if far < 1 then bearing else bearing + swing))
    local aim = math.deg(math.atan2(y - place.y, x - place.x))
    if far >= 1 then
      aim = heading + math.clamp(checks.between(heading, aim), -MOST, MOST)
    end
    return Spoke(at, aim, length, bearing, room, 0)
  end

  system:rule(
    "Spoke(junction, heading, length, bearing, room, tries)",
    function(
      this: Network,
      junction: number,
      heading: number,
      length: number,
      bearing: number,
      room: number,
      tries: number
    )
      local at = this:reached(junction, heading)
      if at then
        local place = this:place(at)
        local far = polar(place)
        local beside = far * math.rad(room)
        if beside > WIDE * random(0.75, 1.6) and rim(bearing) - far > 6 * piece then
          -- It forks: one goes on more or less straight, and the other leaves.
          local share, turn = random(0.3, 0.7), random(6, 52)
          local left, right = bearing + room * share / 2, bearing - room * (1 - share) / 2
          return onward(place, at, heading + turn, left, room * (1 - share)),
            onward(place, at, heading + turn - 58, right, room * share)
        end
        return onward(place, at, heading, bearing, room)
      elseif not this:arrived(junction, heading) and tries < #ASIDE then
        return Spoke(junction, heading + ASIDE[tries + 1], length, bearing, room, tries + 1)
      end
      return nil
    end
  )

  -- The way along the outline from one place to another, counter-clockwise; it swings to both sides, and keeps aside of streets
  -- that lead out at its ends with the headings `leads` and `meets`.
  local function along(from: Vector, to: Vector, leads: number?, meets: number?, tries: number): { number }
    local far, first = polar(from)
    local rest, last = polar(to)
    local gap = (last - first) % 360
    local mean = (far + rest) / 2 * math.rad(gap)
    local count = math.max(1, math.floor(mean / PIECE + 0.5))
    local before, behind = far / rim(first), rest / rim(last)
    local swing = SWING * (1 - tries / TRIES) * mean
    local way = {}
    for number = 1, count - 1 do
      local t = number / count
      local bearing = first + t * gap
      local x, y = place_at(1, bearing)
      local off = swing * math.min(1, 6 * t * (1 - t)) * noise(x * 2.5, y * 2.5, 7.5 + tries, field)
      x, y = place_at((before + t * (behind - before)) * rim(bearing) + off, bearing)
      table.insert(way, x)
      table.insert(way, y)
    end
    local function aside(at: Vector, out: number?, index: number)
      local dx, dy = way[index] - at.x, way[index + 1] - at.y
      local turn = if out then checks.between(out, math.deg(math.atan2(dy, dx))) else 0
      if out and math.abs(turn) > STEEP then
        local aim = math.rad(out + math.sign(turn) * STEEP)
        local long = math.sqrt(dx * dx + dy * dy)
        way[index], way[index + 1] = at.x + long * math.cos(aim), at.y + long * math.sin(aim)
      end
    end
    if count > 2 then
      aside(from, leads, 1)
      aside(to, meets, #way - 1)
    end
    table.insert(way, to.x)
    table.insert(way, to.y)
    return way
  end

  system:rule("Outline", function(this: Network)
    local ends: { any } = {}
    for _, open in this:open_ends() do
      if open.depth == 0 then
        local _, bearing = polar(open.place)
        table.insert(
          ends,
          { junction = open.junction, place = open.place, heading = open.heading, bearing = bearing }
        )
      end
    end
    table.sort(ends, function(one, other)
      return one.bearing < other.bearing
    end)
    local modules = {}
    for index, one in ends do
      local other = ends[index % #ends + 1]
      if (other.bearing - one.bearing) % 360 > 0 then
        local way = along(one.place, other.place, one.heading, other.heading, 0)
        table.insert(modules, Rim(one.junction, way, one.heading, true, other.junction, other.heading, 0))
      end
    end
    if #modules == 0 then
      return nil
    end
    return table.unpack(modules)
  end)

  system:rule(
    "Rim(junction, way, leads, is_end, goal, meets, tries)",
    function(
      this: Network,
      junction: number,
      way: { number },
      leads: number,
      is_end: boolean,
      goal: number,
      meets: number,
      tries: number
    )
      local at, is_done = ways.follow(this, junction, way)
      if is_done or tries >= TRIES then
        return nil
      end
      local start: number = at
      is_end = is_end and at == junction
      if is_end and tries >= 2 then
        -- It leaves one piece before the end of the main street.
        local corners = this:face(at, leads + 180).corners
        start = corners[2 % #corners + (if #corners == 1 then 1 else 0)].junction
      end
      -- It ends on the main street, before its end.
      local back = BEFORE * tries * vec(math.cos(math.rad(meets)), math.sin(math.rad(meets)), 0)
      local ends = this:place(goal) - back
      local leaves = if is_end then leads else nil
      local onward = along(this:place(start), ends, leaves, meets, tries + 1)
      return Rim(start, onward, leads, is_end, goal, meets, tries + 1)
    end
  )

  -- Where no land lies between streets, all of them would be removed.
  system:rule("Trim", function()
    return nil
  end)
  system:interpret("Trim", function(this: Network)
    local count = 0
    for _, corner in this:places() do
      count += if #corner.headings > 0 then 1 else 0
    end
    if this:size() >= count then
      this:remove_dead_ends()
    end
  end)

  system:interpret(
    "Spoke(junction, heading, length, bearing, room, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      propose(this, junction, heading, length, 0)
    end
  )
  system:interpret(
    "Rim(junction, way, leads, is_end, goal, meets, tries)",
    function(this: Network, junction: number, way: { number })
      ways.lead(this, junction, way, 1, propose)
    end
  )

  -- The main streets that leave the centre towards headings.
  return function(this: Network, junction: number, headings: { number }): { any }
    local place = this:place(junction)
    local sorted = table.clone(headings)
    table.sort(sorted, function(one, other)
      return one % 360 < other % 360
    end)
    local modules = {}
    for index, heading in sorted do
      local before = sorted[(index - 2) % #sorted + 1]
      local after = sorted[index % #sorted + 1]
      local room = if #sorted == 1 then 180 else ((heading - before) % 360 + (after - heading) % 360) / 2
      table.insert(modules, onward(place, junction, heading, heading, room))
    end
    return modules
  end
end

return mains
