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
-- A street along the outline, on its way to the end of a main street that would lead on with a heading (degrees).
local Rim = module("Rim", "junction", "heading", "length", "goal", "meets", "tries")
-- Removes streets that lead nowhere.
local Trim = module("Trim")

mains.Outline, mains.Trim = Outline, Trim
mains.GROWING = {
  "Spoke(junction, heading, length, bearing, room, tries)",
  "Outline",
  "Rim(junction, heading, length, goal, meets, tries)",
  "Trim",
}

-- How far (degrees) a main street turns when it is refused, one try after the other.
local ASIDE = { 20, -40, 60, -80 }
-- How far (degrees) it turns from one piece to the next.
local MOST = 18
-- How often the outline is tried where it is refused, how long (m) its pieces are about, and how far (degrees) they turn to find a way.
local TRIES, PIECE = 4, 46
local TURNS = { 0, 8, -8, 16, -16, 26, -26, 38, -38, 52, -52, 66, -66, 80, -80 }
-- How much nearer (m) to the centre each further try ends.
local BEFORE = 22
-- For how many bearings the outline is computed.
local BEARINGS = 180
-- How far the outline lies from the border of the land, as shares of the distance of the border from the centre.
local NEAREST, FARTHEST = 0.62, 0.97
-- How wide the land beside a main street is about when it forks, (m).
local WIDE = 460
-- How many main streets leave the centre, and the least angle (degrees) between two.
local COUNT, APART = { 3, 5 }, 56
-- How long (m) their first pieces are at least.
local FIRST = 52

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
    local share = 0.76
      - long * math.cos(2 * (bearing - math.rad(turned)))
      + 0.22 * noise(0.9 * east, 0.9 * north, 0.5, field)
      + 0.07 * noise(3 * east, 3 * north, 4.5, field)
      + 0.03 * noise(8 * east, 8 * north, 8.5, field)
    distances[index] = far * math.clamp(share, NEAREST, FARTHEST)
  end
  return function(bearing: number): number
    local at = bearing % 360 / 360 * BEARINGS
    local index = math.floor(at)
    local low, high = distances[index % BEARINGS], distances[(index + 1) % BEARINGS]
    return low + (at - index) * (high - low)
  end
end

-- The rules of what removes streets that lead nowhere.
function mains.trims(system: System<Network>)
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
  propose: any
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
    if rest < 0.9 * piece then
      return nil
    end
    local usual = if far < 1 then math.max(piece, math.min(FIRST, 0.3 * rest)) else piece
    local length = if rest < 1.9 * usual then rest else usual
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

  -- The next piece of the outline on its way to the end of a main street, counter-clockwise: the first of some that can be
  -- built.
  local function along(this: Network, at: number, goal: number, meets: number, tries: number): any
    local place, ends = this:place(at), this:place(goal)
    local far, bearing = polar(place)
    local rest, last = polar(ends)
    local gap = (last - bearing) % 360
    local function may_lead(x: number, y: number, turn: number, joins: boolean): any
      local heading = math.deg(math.atan2(y - place.y, x - place.x)) + turn
      local length = math.sqrt((x - place.x) ^ 2 + (y - place.y) ^ 2)
      local found = this:probe(at, heading, length, 1)
      local is_fit = found.built and (not joins or found.fate == "snapped" or found.fate == "joined")
      return if is_fit then Rim(at, heading, length, goal, meets, tries) else nil
    end
    if place:distance(ends) < 1.7 * PIECE or gap > 300 then
      -- It ends at the main street, or before the end of that.
      for back = 0, 4 do
        local off = back * BEFORE * vec(math.cos(math.rad(meets)), math.sin(math.rad(meets)), 0)
        for _, turn in TURNS do
          local x, y = ends.x - off.x, ends.y - off.y
          local found = may_lead(x, y, turn, true)
          if found then
            return found
          end
        end
      end
    end
    local ahead = math.min(bearing + math.deg(PIECE / far), bearing + gap)
    -- It comes back to the outline where it is off.
    local share = far / rim(bearing)
    local next_share = share
      + (rest / rim(last) - share) * math.min(1, 1.2 * (ahead - bearing) / math.max(gap, 1))
    local x, y = place_at(next_share * rim(ahead), ahead)
    for _, turn in TURNS do
      local found = may_lead(x, y, turn, false)
      if found then
        return found
      end
    end
    return nil
  end

  system:rule("Outline", function(this: Network)
    local ends: { any } = {}
    for _, open in this:open_ends() do
      if open.depth == 0 then
        local _, bearing = polar(open.place)
        table.insert(ends, { junction = open.junction, heading = open.heading, bearing = bearing })
      end
    end
    table.sort(ends, function(one: any, other: any): boolean
      return one.bearing < other.bearing
    end)
    local modules: { any } = {}
    for index, one in ends do
      local other = ends[index % #ends + 1]
      local from, heading = one.junction, one.heading
      -- It leaves some pieces before the end of a main street where it cannot leave there.
      for _ = 1, TRIES do
        local found = if #ends > 1 then along(this, from, other.junction, other.heading, 0) else nil
        if found then
          table.insert(modules, found)
          break
        end
        local corners = this:face(from, heading + 180).corners
        from = corners[2 % #corners + (if #corners == 1 then 1 else 0)].junction
        local back = this:place(from) - this:place(one.junction)
        heading = math.deg(math.atan2(-back.y, -back.x))
      end
    end
    if #modules == 0 then
      return nil
    end
    return table.unpack(modules)
  end)

  system:rule(
    "Rim(junction, heading, length, goal, meets, tries)",
    function(
      this: Network,
      junction: number,
      heading: number,
      _: number,
      goal: number,
      meets: number,
      tries: number
    )
      local at = this:reached(junction, heading)
      if at then
        return along(this, at, goal, meets, tries)
      elseif not this:arrived(junction, heading) and tries < TRIES then
        return along(this, junction, goal, meets, tries + 1)
      end
      return nil
    end
  )

  system:interpret(
    "Spoke(junction, heading, length, bearing, room, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      propose(this, junction, heading, length, 0)
    end
  )
  system:interpret(
    "Rim(junction, heading, length, goal, meets, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      propose(this, junction, heading, length, 1)
    end
  )

  -- The main streets that leave the centre towards headings.
  return function(this: Network, junction: number, headings: { number }): { any }
    local place = this:place(junction)
    local sorted = table.clone(headings)
    table.sort(sorted, function(one: number, other: number): boolean
      return one % 360 < other % 360
    end)
    local modules: { any } = {}
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
