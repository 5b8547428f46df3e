--!strict
-- Main streets of a town around one centre. They lead from the centre to the outline of the town, and a street along
-- the outline joins their ends, so that all land inside is between streets.
local checks = require("checks")
local ways = require("ways")

local mains = {}

type Pattern = any

-- A growing main street: the bearing (degrees) from the centre that it follows, and its free angle (degrees).
local Spoke = module("Spoke", "junction", "heading", "length", "bearing", "room", "tries")
-- Joins the ends of main streets along the outline.
local Outline = module("Outline")
-- A street along the outline, on its way to a junction of a main street that leads outwards with a heading (degrees).
local Rim = module("Rim", "junction", "heading", "length", "goal", "meets", "depth", "tries")
-- A sector from a junction with a failed outline; it stays until growth ends.
local Unclosed = module("Unclosed", "x", "y")
-- Removes streets that lead nowhere.
local Trim = module("Trim")

mains.Outline, mains.Trim = Outline, Trim
mains.GROWING = {
  "Spoke(junction, heading, length, bearing, room, tries)",
  "Outline",
  "Rim(junction, heading, length, goal, meets, depth, tries)",
  "Trim",
}

-- The turns (degrees) of a refused main street, one attempt after the other.
local ASIDE = { 20, -40, 60, -80 }
-- The maximum turn (degrees) between two pieces.
local MOST = 18
-- The number of attempts of a refused outline, the usual length (m) of its pieces, and the turns (degrees) of
-- attempts.
local TRIES, PIECE = 4, 46
local TURNS = { 0, 8, -8, 16, -16, 26, -26, 38, -38, 52, -52, 66, -66, 80, -80 }
-- The distance (m) between attempts to end nearer to the centre or farther away, and their order.
local BEFORE, BACK = 22, { 0, 1, 2, -1, 3, -2, 4, -3, 5, 6 }
-- The distance from its end, in pieces, at which the outline may join a main street.
local NEAR = 2.6
-- The number of bearings at which the outline is computed.
local BEARINGS = 180
-- The minimum and the maximum distance of the outline from the centre, as fractions of the distance of the boundary
-- of the land.
local NEAREST, FARTHEST = 0.62, 0.97
-- The depths (fractions of the distance from the centre) of a sector's outline before the ends of its main streets,
-- each with the cumulative fraction of sectors: gardens and fields extend into some sectors.
local WEDGES = { { 0.3, 0, 0.08 }, { 0.7, 0.08, 0.2 }, { 1, 0.2, 0.36 } }
-- The fraction of sectors whose outline is a lane.
local LANES = 0.4
-- The usual width (m) of the land next to a main street that forks.
local WIDE = 460
-- The number of main streets that leave the centre, and the minimum angle (degrees) between two of them.
local COUNT, APART = { 3, 5 }, 56
-- The minimum length (m) of their first pieces.
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
    local share = 0.84
      - long * math.cos(2 * (bearing - math.rad(turned)))
      + 0.22 * noise(0.9 * east, 0.9 * north, 0.5, field)
      + 0.1 * noise(3 * east, 3 * north, 4.5, field)
      + 0.05 * noise(8 * east, 8 * north, 8.5, field)
    distances[index] = far * math.clamp(share, NEAREST, FARTHEST)
  end
  return function(bearing: number): number
    local at = bearing % 360 / 360 * BEARINGS
    local index = math.floor(at)
    local low, high = distances[index % BEARINGS], distances[(index + 1) % BEARINGS]
    return low + (at - index) * (high - low)
  end
end

-- The rules that remove streets that lead nowhere.
function mains.trims(system: System<Network>)
  -- If no land is between streets, all of them would be removed.
  system:rule("Trim", function()
    return nil
  end)
  system:interpret("Unclosed(x, y)", function() end)
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

-- The default headings (degrees) of main streets that leave a centre.
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
  propose: any,
  deepest: number
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
    -- The street swings between the centre and the outline, which it meets at about a right angle.
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
      local at = this:open_end(junction, heading)
      if at then
        local place = this:place(at)
        local far = polar(place)
        local beside = far * math.rad(room)
        if beside > WIDE * random(0.75, 1.6) and rim(bearing) - far > 6 * piece then
          -- At a fork, one street continues approximately straight, and the other leaves.
          local share, turn = random(0.3, 0.7), random(6, 52)
          local left, right = bearing + room * share / 2, bearing - room * (1 - share) / 2
          return onward(place, at, heading + turn, left, room * (1 - share)),
            onward(place, at, heading + turn - 58, right, room * share)
        end
        return onward(place, at, heading, bearing, room)
      elseif not this:end_junction(junction, heading) and tries < #ASIDE then
        return Spoke(junction, heading + ASIDE[tries + 1], length, bearing, room, tries + 1)
      end
      return nil
    end
  )

  -- The next piece of the outline on its way to the end of a main street, counter-clockwise: the first of some
  -- candidates that can be built.
  local function along(
    this: Network,
    at: number,
    goal: number,
    meets: number,
    depth: number,
    tries: number,
    is_near: boolean
  ): any
    local place, ends = this:place(at), this:place(goal)
    local far, bearing = polar(place)
    local rest, last = polar(ends)
    local gap = (last - bearing) % 360
    local function may_lead(x: number, y: number, turn: number, joins: boolean): any
      local heading = math.deg(math.atan2(y - place.y, x - place.x)) + turn
      local length = math.sqrt((x - place.x) ^ 2 + (y - place.y) ^ 2)
      local found = this:probe(at, heading, length, depth)
      local is_fit = found.built and (not joins or found.outcome == "snapped" or found.outcome == "joined")
      return if is_fit then Rim(at, heading, length, goal, meets, depth, tries) else nil
    end
    if is_near or place:distance(ends) < NEAR * PIECE or gap > 300 then
      -- The piece ends at the main street, or before or behind the chosen position there.
      for _, back in BACK do
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
    -- The piece returns to the outline after a deviation.
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

  local function unclosed(this: Network, junction: number): any
    local place = this:place(junction)
    return Unclosed(place.x, place.y)
  end

  -- The junctions of a main street from its open end inwards, with the heading that leads outwards at each.
  local function inwards(this: Network, junction: number, heading: number): { any }
    local corners = this:face(junction, heading + 180).corners
    local found, out = {}, heading
    for index, corner in corners do
      table.insert(found, { junction = corner.junction, heading = out, far = polar(corner.place) })
      local after = corners[index % #corners + 1]
      local way = corner.place - after.place
      out = math.deg(math.atan2(way.y, way.x))
      if after.degree ~= 2 then
        break
      end
    end
    return found
  end

  -- The index in a list of junctions of a main street where the outline of a sector meets it, for a depth of the
  -- sector.
  local function meeting(list: { any }, wedge: number): number
    local index = 1
    while index < #list - 2 and list[index + 1].far >= (1 - wedge) * list[1].far do
      index += 1
    end
    return index
  end

  system:rule("Outline", function(this: Network)
    local ends: { any } = {}
    for _, open in this:open_ends() do
      if open.depth == 0 then
        local _, bearing = polar(open.place)
        table.insert(ends, { bearing = bearing, list = inwards(this, open.junction, open.heading) })
      end
    end
    table.sort(ends, function(one: any, other: any): boolean
      return one.bearing < other.bearing
    end)
    for index, one in ends do
      local drawn, other = random(), ends[index % #ends + 1]
      for _, wedge in WEDGES do
        if drawn < wedge[1] then
          local depth = random(wedge[2], wedge[3])
          one.leaves, other.arrives = meeting(one.list, depth), meeting(other.list, depth)
          break
        end
      end
    end
    local modules: { any } = {}
    for index, one in ends do
      local other = ends[index % #ends + 1]
      local list, goal = one.list, other.list[other.arrives]
      -- Streets of two sectors leave a main street at different junctions.
      local leaves: number = one.leaves :: any
      if leaves == one.arrives and #list > leaves then
        leaves += 1
      end
      local depth = if random() < LANES then math.min(2, deepest) else 1
      -- If the outline cannot leave there, it leaves some pieces further in.
      local last = math.min(leaves + TRIES - 1, #list)
      for from = leaves, last do
        local found = if #ends > 1
          then along(this, list[from].junction, goal.junction, goal.heading, depth, 0, false)
          else nil
        if found then
          table.insert(modules, found)
          break
        elseif from == last then
          table.insert(modules, unclosed(this, list[1].junction))
        end
      end
    end
    return checks.successor(modules)
  end)

  system:rule(
    "Rim(junction, heading, length, goal, meets, depth, tries)",
    function(
      this: Network,
      junction: number,
      heading: number,
      _: number,
      goal: number,
      meets: number,
      depth: number,
      tries: number
    )
      local at = this:open_end(junction, heading)
      if at then
        -- A street that is too near to its end is shortened by a piece.
        return along(this, at, goal, meets, depth, tries, false)
          or along(this, junction, goal, meets, depth, tries, true)
          or unclosed(this, at)
      elseif not this:end_junction(junction, heading) and tries < TRIES then
        return along(this, junction, goal, meets, depth, tries + 1, false) or unclosed(this, junction)
      end
      return if this:end_junction(junction, heading) then nil else unclosed(this, junction)
    end
  )

  system:interpret(
    "Spoke(junction, heading, length, bearing, room, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      propose(this, junction, heading, length, 0)
    end
  )
  system:interpret(
    "Rim(junction, heading, length, goal, meets, depth, tries)",
    function(
      this: Network,
      junction: number,
      heading: number,
      length: number,
      _: number,
      _: number,
      depth: number
    )
      propose(this, junction, heading, length, depth)
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
