--!strict
-- Cuts: the courses of streets that divide an area between streets, and of lanes that end there.
local areas = require("areas")
local checks = require("checks")

local cuts = {}

type Pattern = any
type Area = any

-- Lengths (m) that follow from the widths of streets, by their depth.
export type Sizes = {
  -- The minimum straight piece of a street.
  piece: { [number]: number },
  -- The minimum piece where a street leaves another, by the depth of both.
  first: { [number]: { [number]: number } },
  -- The minimum distance of streets that leave the same side of another street.
  near: { [number]: number },
  -- The minimum distance between streets, by the depth of both.
  apart: { [number]: { [number]: number } },
  deepest: number,
}

-- A street that may divide an area, from a corner to a place on the piece of the outline behind another one, with the heading
-- (degrees) of the way there.
export type Candidate = {
  -- The cost without the share of the area, and the whole cost.
  fixed: number,
  cost: number,
  share: number,
  corner: number,
  edge: number,
  x: number,
  y: number,
  heading: number,
  -- The greatest turns (degrees) to one side and to the other where it leaves and where it arrives.
  leaves: { number },
  arrives: { number },
}

-- The number of the best dividing streets that are tried, and the distance that each keeps from others, as a share of the width of
-- blocks.
local BEST = 12
local WIDTH = 0.2
-- The least width (m) of an area that is divided further.
local STRIP = 28
-- The area (m²) of a small block, and how many of the largest blocks of a place that is at most.
local SMALL, SMALLEST = 500, 2
-- From how many junctions of an area streets are tried, and how far (degrees) they turn from the middle of the angle there.
local STARTS = 12
local TURNS = { 0, 9, -9, 18, -18, 27, -27, 36, -36 }
local END_TURNS = { 0, 15, -15, 30, -30, 50, -50, 75, -75 }
-- The minimum angle (degrees) between two streets, and the remaining angle for a street that leaves between two
-- others.
local LEAST = 52
local WIDE = 2 * LEAST + 8
-- The tension of streets towards the headings in which they leave.
local TENSION = 1.45
-- The number of parts in which the length of a street is computed.
local SAMPLES = 16
-- The minimum distance (m) of the end of a lane from other streets, and the length (m) of lanes.
local APART = 38
local LANE = { 40, 170 }
-- The minimum and the maximum turn (degrees) of a lane, and the maximum turn in the country around a town.
local BENDS, COUNTRY = { 25, 105 }, 70
-- The minimum distance (m) of a lane from other junctions.
local BESIDE = 52
-- The maximum length (m) of a stub.
local STUB = 26

-- The lengths that follow from the widths (m) of streets by depth, their clearance (m) and the radius (m) of corners.
function cuts.sizes(widths: { number }, clearance: number, corner: number): Sizes
  local sizes: any = { piece = {}, first = {}, near = {}, apart = {}, deepest = #widths - 1 }
  for depth = 0, sizes.deepest do
    local wide = widths[depth + 1]
    sizes.piece[depth] = math.max(wide + clearance + 1.5, 13)
    sizes.near[depth] = math.max(wide + 2 * corner + 1, 14)
    sizes.apart[depth], sizes.first[depth] = {}, {}
    for other = 0, sizes.deepest do
      local apart = (wide + widths[other + 1]) / 2 + clearance
      sizes.apart[depth][other] = apart + 0.5
      -- The street may leave obliquely.
      sizes.first[depth][other] = math.max(1.22 * apart, 14)
    end
  end
  return sizes
end

-- The positions of a street between two positions that leaves and arrives with headings, in pieces of at least a
-- length (m): the first, the inner ones, and the last. With more tension, it follows the headings farther.
local function curve(
  from: { number },
  to: { number },
  leaves: number,
  arrives: number,
  pieces: { number },
  tension: number
): { number }
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local pull = tension * math.sqrt(dx * dx + dy * dy)
  local ax, ay = pull * math.cos(math.rad(leaves)), pull * math.sin(math.rad(leaves))
  local bx, by = pull * math.cos(math.rad(arrives)), pull * math.sin(math.rad(arrives))
  -- A cubic curve by its ends and its tangents there.
  local function at(t: number): (number, number)
    local u = 1 - t
    local p, q, r, s = u * u * (1 + 2 * t), t * t * (3 - 2 * t), u * u * t, -t * t * u
    return p * from[1] + q * to[1] + r * ax + s * bx, p * from[2] + q * to[2] + r * ay + s * by
  end
  local lengths, x, y = { 0 }, from[1], from[2]
  for sample = 1, SAMPLES do
    local next_x, next_y = at(sample / SAMPLES)
    lengths[sample + 1] = lengths[sample] + math.sqrt((next_x - x) ^ 2 + (next_y - y) ^ 2)
    x, y = next_x, next_y
  end
  local far = lengths[SAMPLES + 1]
  local first, usual, last = pieces[1], pieces[2], pieces[3]
  local way = {}
  if far >= first + last then
    local between = math.floor((far - first - last) / usual)
    local stretch = far / (first + last + between * usual)
    local sample = 1
    for index = 0, between do
      local along = stretch * (first + index * usual)
      while sample < SAMPLES and lengths[sample + 1] < along do
        sample += 1
      end
      local part = (along - lengths[sample]) / (lengths[sample + 1] - lengths[sample])
      local east, north = at((sample - 1 + part) / SAMPLES)
      table.insert(way, east)
      table.insert(way, north)
    end
  end
  table.insert(way, to[1])
  table.insert(way, to[2])
  return way
end

-- Tests if a street of a depth may leave or arrive at a corner.
local function is_apart(sizes: Sizes, area: Area, corner: number, depth: number): boolean
  local other = math.min(area.depth[corner], area.depth[(corner - 2) % area.count + 1], sizes.deepest)
  return areas.is_apart(area, corner, sizes.apart[depth][other], sizes.near[depth])
end

-- Returns the end of a street from a corner of an area towards a heading: the position, the corner before it, and the
-- heading (degrees) that leads out there. In a short piece, the street ends at a corner, with room for the other
-- streets there.
local function arrival(
  sizes: Sizes,
  area: Area,
  corner: number,
  heading: number,
  crossing: boolean,
  depth: number
): (number?, number, number, number)
  local far, edge = areas.hit(area, corner, heading)
  if not far then
    return nil, 0, 0, 0
  end
  local x = area.x[corner] + far * math.cos(math.rad(heading))
  local y = area.y[corner] + far * math.sin(math.rad(heading))
  local after = edge % area.count + 1
  local before_it = math.sqrt((x - area.x[edge]) ^ 2 + (y - area.y[edge]) ^ 2)
  local behind_it = math.sqrt((x - area.x[after]) ^ 2 + (y - area.y[after]) ^ 2)
  local bends = sizes.apart[depth][math.min(area.depth[edge], sizes.deepest)]
  local function is_clear(at: number, apart: number): boolean
    return apart >= (if area.degree[at] == 2 then bends else math.max(bends, sizes.near[depth]))
  end
  if is_clear(edge, before_it) and is_clear(after, behind_it) then
    return x, y, edge, areas.heading(area, edge) - 90
  end
  local ends = if before_it < behind_it then { edge, after } else { after, edge }
  for _, at in ends do
    local open, middle = areas.angle(area, at)
    local apart = math.min((at - corner) % area.count, (corner - at) % area.count)
    local is_free = area.degree[at] == 2 or crossing and area.degree[at] == 3
    if apart > 1 and open >= WIDE and open < 250 and is_free and is_apart(sizes, area, at, depth) then
      local way = math.deg(math.atan2(area.y[at] - area.y[corner], area.x[at] - area.x[corner]))
      if math.abs(checks.between(way, middle + 180)) <= open / 2 - LEAST then
        return area.x[at], area.y[at], at, middle + 180
      end
    end
  end
  return nil, 0, 0, 0
end

local function pieces_of(sizes: Sizes, area: Area, corner: number, edge: number, depth: number): { number }
  local first = sizes.first[depth]
  local last = sizes.deepest
  return {
    first[math.min(area.depth[corner], last)],
    sizes.piece[depth],
    first[math.min(area.depth[edge], last)],
  }
end

-- Tests if a street that leaves a position (m) keeps its distance (m) from the outline of an area between its ends.
local function is_clear(area: Area, from: { number }, way: { number }, apart: number): boolean
  local last = #way
  for index = 1, last - 2, 2 do
    local x, y = way[index], way[index + 1]
    local begun = math.sqrt((x - from[1]) ^ 2 + (y - from[2]) ^ 2)
    local rest = math.sqrt((x - way[last - 1]) ^ 2 + (y - way[last]) ^ 2)
    if areas.distance(area, x, y) < math.min(apart, 0.7 * begun, 0.7 * rest) then
      return false
    end
  end
  return true
end

-- The headings where a street leaves and arrives that swings to the left (above 0) or to the right, as far as it may turn there.
local function bent(street: Candidate, swing: number): (number, number)
  local out = math.deg(4 * swing)
  local leaves = math.clamp(out, street.leaves[2], street.leaves[1])
  local arrives = math.clamp(-out, street.arrives[2], street.arrives[1])
  return street.heading + leaves, street.heading + arrives
end

-- The least area (m²) of the larger one of two parts into which a street divides an area where blocks have up to `limit` (m²): a small
-- block lies beside a larger one, so that many of them do not lie together.
function cuts.larger(limit: number): number
  return math.min(SMALL, SMALLEST * limit)
end

-- The streets that may divide an area, with what they cost apart from their share; `crossing` tells whether one may leave opposite
-- another street.
function cuts.candidates(
  sizes: Sizes,
  area: Area,
  pattern: Pattern,
  limit: number,
  depth: number,
  crossing: boolean
): { Candidate }
  local size = math.sqrt(area.size)
  local least = math.max(pattern.least * pattern.least, 0.08 * math.min(limit, area.size))
  local larger = cuts.larger(limit)
  local found: { Candidate } = {}
  local first, stride = math.floor(random() * area.count), math.max(1, area.count / STARTS)
  for number = 0, math.min(STARTS, area.count) - 1 do
    local corner = 1 + math.floor(first + number * stride) % area.count
    local open, middle = areas.angle(area, corner)
    local degree = area.degree[corner]
    local is_free = degree < 3 or degree == 3 and crossing
    if open < WIDE or not is_free or not is_apart(sizes, area, corner, depth) then
      continue
    end
    local cost = if degree == 3 then -0.3 elseif degree == 1 then -1 else 0
    for _, turn in if degree == 1 then END_TURNS else TURNS do
      if math.abs(turn) > open / 2 - LEAST then
        continue
      end
      local x, y, edge, out = arrival(sizes, area, corner, middle + turn, crossing, depth)
      if not x then
        continue
      end
      local dx, dy = x - area.x[corner], y - area.y[corner]
      local heading = math.deg(math.atan2(dy, dx))
      local off, turned = checks.between(heading, out), checks.between(middle, heading)
      local part = areas.part(area, corner, edge, x, y)
      part = math.min(part, area.size - part)
      if
        part < least
        or area.size - part < larger
        or math.abs(off) > 42
        or math.abs(turned) > math.min(open / 2 - LEAST, 80)
      then
        continue
      end
      local along = math.abs((heading - area.turned + 45) % 90 - 45)
      local candidate: Candidate = {
        fixed = cost + 0.55 * math.sqrt(dx * dx + dy * dy) / size + (off / 26) ^ 2 + (if degree == 1
          then 0
          else (turned / 30) ^ 2) + along / 60,
        cost = 0,
        share = part / area.size,
        corner = corner,
        edge = edge,
        x = x,
        y = y,
        heading = heading,
        leaves = { turned + open / 2 - LEAST, turned - open / 2 + LEAST },
        arrives = { off + 90 - LEAST, off - 90 + LEAST },
      }
      table.insert(found, candidate)
    end
  end
  return found
end

-- The best of the streets that may divide an area, as the corner that it leaves and its places; nil if there is none. `may_begin`
-- says whether one may.
function cuts.cut(
  sizes: Sizes,
  area: Area,
  pattern: Pattern,
  limit: number,
  depth: number,
  tries: number,
  found: { Candidate },
  may_begin: (corner: number, way: { number }, depth: number) -> boolean
): (number?, { number }?)
  -- Parts differ, so that blocks do.
  local share = random(0.05, 0.5)
  -- The last streets of an area are the most crooked.
  local is_last = area.size < 3 * limit
  local bow = pattern.bow
    * (if is_last then random(0.9, 1.5) else random(0.4, 1.1))
    * math.max(0, 1 - tries / 12)
  for _, one in found do
    local uneven = 2 * (share - one.share)
    one.cost = one.fixed + 2.2 * uneven * uneven + 0.35 * random()
  end
  table.sort(found, function(one: Candidate, other: Candidate): boolean
    return one.cost < other.cost
  end)
  -- Land that is divided further must be wide enough for a street across it.
  local strip = if area.size > 2.5 * limit then STRIP else 0
  local apart =
    math.max(sizes.apart[depth][sizes.deepest], strip, WIDTH * math.sqrt(math.min(limit, area.size)))
  for index = 1, math.min(#found, BEST) do
    local one = found[index]
    local from = { area.x[one.corner], area.y[one.corner] }
    local pieces = pieces_of(sizes, area, one.corner, one.edge, depth)
    -- To the side with more room, to the other side, and nearly straight.
    local side = if one.leaves[1] - one.arrives[2] > one.arrives[1] - one.leaves[2] then 1 else -1
    for _, swing in { side * bow, -side * bow, 0 } do
      local leaves, arrives = bent(one, swing)
      local way = curve(from, { one.x, one.y }, leaves, arrives, pieces, TENSION)
      if is_clear(area, from, way, apart) and may_begin(one.corner, way, depth) then
        return one.corner, way
      end
    end
  end
  return nil, nil
end

-- A crescent, which leaves a street and returns to it after about this distance (m), in the form of `cut`.
function cuts.crescent(
  sizes: Sizes,
  area: Area,
  wide: number,
  depth: number,
  may_begin: (corner: number, way: { number }, depth: number) -> boolean
): (number?, { number }?)
  for _ = 1, 20 do
    local corner = 1 + math.floor(random() * area.count)
    local open, middle = areas.angle(area, corner)
    if open < WIDE or open > 230 or area.degree[corner] ~= 2 or not is_apart(sizes, area, corner, depth) then
      continue
    end
    local from = { area.x[corner], area.y[corner] }
    local edge = corner
    for _ = 1, area.count - 2 do
      edge = edge % area.count + 1
      local after = edge % area.count + 1
      local dx, dy = area.x[after] - area.x[edge], area.y[after] - area.y[edge]
      local long = math.sqrt(dx * dx + dy * dy)
      local to, out = { area.x[edge], area.y[edge] }, 0
      if
        long
        > 2 * math.max(sizes.near[depth], sizes.apart[depth][math.min(area.depth[edge], sizes.deepest)])
      then
        to = { to[1] + dx / 2, to[2] + dy / 2 }
        out = areas.heading(area, edge) - 90
      elseif area.degree[edge] == 2 and is_apart(sizes, area, edge, depth) then
        local angle, inward = areas.angle(area, edge)
        out = inward + 180
        if angle < WIDE or angle > 230 then
          continue
        end
      else
        continue
      end
      local far = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2)
      if far > 1.5 * wide then
        break
      elseif far < wide then
        continue
      end
      local along = math.deg(math.atan2(to[2] - from[2], to[1] - from[1]))
      if
        math.abs(checks.between(middle, out)) < 130
        or math.abs(checks.between(middle, along)) < LEAST
        or math.abs(checks.between(out, along)) < LEAST
      then
        continue
      end
      -- The swing is a quarter of the tension.
      local other = math.min(area.depth[corner], area.depth[edge], sizes.deepest)
      local tension = math.max(random(2.8, 4.2), 4 * (sizes.apart[depth][other] + 2) / far)
      local way = curve(from, to, middle, out, pieces_of(sizes, area, corner, edge, depth), tension)
      if
        #way > 4
        and is_clear(area, from, way, sizes.apart[depth][sizes.deepest])
        and may_begin(corner, way, depth)
      then
        return corner, way
      end
    end
  end
  return nil, nil
end

-- A lane that ends within an area, in the form of `cut`, away from other streets. It leaves streets of a depth or
-- less, or continues a stub.
function cuts.lane(sizes: Sizes, area: Area, deepest: number): (number?, { number }?)
  local corners: { number } = {}
  for corner = 1, area.count do
    local after = corner % area.count + 1
    if area.degree[corner] == 1 and area.degree[after] > 2 and areas.length(area, corner) < STUB then
      table.insert(corners, corner)
    end
  end
  local stubs = #corners
  for _ = 1, 24 do
    table.insert(corners, 1 + math.floor(random() * area.count))
  end
  for index, corner in corners do
    local is_stub = index <= stubs
    local open, middle = areas.angle(area, corner)
    local depth = math.max(area.depth[corner], area.depth[(corner - 2) % area.count + 1])
    if not is_stub and (open < WIDE or area.degree[corner] ~= 2 or depth > deepest) then
      continue
    end
    local x, y = area.x[corner], area.y[corner]
    local heading = middle + random(-12, 12)
    local wanted = random(LANE[1], LANE[2])
    local is_apart = true
    for other = 1, if is_stub then 0 else area.count do
      local near = (area.x[other] - x) ^ 2 + (area.y[other] - y) ^ 2
      if area.degree[other] == 3 and near <= BESIDE * BESIDE then
        is_apart = false
        break
      end
    end
    if not is_apart then
      continue
    end
    local long = math.min((areas.hit(area, corner, heading) or math.huge) - APART, wanted)
    if long < (if is_stub then STUB else LANE[1]) then
      continue
    end
    local turn = (if random() < 0.5 then 1 else -1)
      * random(BENDS[1], if area.size < 0 then COUNTRY else BENDS[2])
    local aim = heading + 0.5 * turn
    local to = { x + long * math.cos(math.rad(aim)), y + long * math.sin(math.rad(aim)) }
    if areas.distance(area, to[1], to[2], heading + turn) > APART then
      return corner,
        curve({ x, y }, to, heading, heading + turn, pieces_of(sizes, area, corner, corner, 2), TENSION)
    end
  end
  return nil, nil
end

return cuts
