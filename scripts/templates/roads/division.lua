--!strict
-- Division: the land between main streets is divided by finer streets, until no block is larger than the blocks of its place.
local areas = require("areas")
local checks = require("checks")

local division = {}

type Pattern = any
type Area = areas.Area

-- The area on the left of the street that leaves a junction towards a heading (degrees), and how often it could not be divided.
local Quarter = module("Quarter", "junction", "heading", "tries")
-- A street through an area of a size (m²), from a junction by places (m), x and y in turn.
local Cut = module("Cut", "junction", "way", "depth", "area", "tries")
-- A lane that ends within a block, or beyond the last street of the town.
local Lane = module("Lane", "junction", "way", "depth", "tries")
-- Divides what main streets enclose.
local Land = module("Land")

-- How many ways to divide an area are tried before it stays as it is, and how many if it is larger (m²) than any block may be.
local TRIES, MORE_TRIES = 8, 16
local LARGE = 60000
-- From how many junctions of an area streets are tried, and how far (degrees) they turn from the middle of the angle there.
local STARTS = 12
local TURNS = { 0, 14, -14, 28, -28 }
-- The least angle (degrees) between two streets, and what is left for one that leaves between two others.
local LEAST = 52
local WIDE = 2 * LEAST + 8
-- How long (m) the straight pieces of a street are about, and how near its end may lie to where another turns, or meets
-- others.
local PIECE, SHORT_PIECE, WIDER = 24, 19, 8
local LANE_PIECES = { 28, 26, 24 }
local NEAR, FAR = 18, 26
-- How far (m) the end of a lane is from other streets at least, how long it is until it turns, and how much land has one.
local APART = 31
local LANE = { 30, 120 }
local LANE_LAND = 3500
-- The largest area (m²) that is left as it is for a park or an estate.
local ESTATE = 40000
-- The least area (m²) that a street divides, not a lane.
local STREET = 16000

-- The places of a street from one place to another that leaves and arrives towards headings, bowed by a share of the way, in pieces
-- of a length (m) or more; the first and the last have more where they meet a wide street.
local function curve(
  from: { number },
  to: { number },
  leaves: number,
  arrives: number,
  pieces: { number },
  bow: number
): { number }
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local far = math.sqrt(dx * dx + dy * dy)
  local ax, ay = far * math.cos(math.rad(leaves)), far * math.sin(math.rad(leaves))
  local bx, by = far * math.cos(math.rad(arrives)), far * math.sin(math.rad(arrives))
  local first, usual, last = pieces[1], pieces[2], pieces[3]
  local parts = { 1 }
  if far >= first + last then
    local between = math.floor((far - first - last) / usual)
    local stretch = far / (first + last + between * usual)
    parts = {}
    for index = 0, between do
      table.insert(parts, stretch * (first + index * usual) / far)
    end
    table.insert(parts, 1)
  end
  local way = {}
  for _, t in parts do
    local u = 1 - t
    -- A cubic curve by its ends and what it is tangent to there.
    local p, q, r, s = u * u * (1 + 2 * t), t * t * (3 - 2 * t), u * u * t, -t * t * u
    local out = 4 * bow * t * u
    table.insert(way, p * from[1] + q * to[1] + r * ax + s * bx - out * dy)
    table.insert(way, p * from[2] + q * to[2] + r * ay + s * by + out * dx)
  end
  return way
end

-- Where a street from a corner of an area towards a heading ends on the other side: the place, the corner before it, and the
-- heading (degrees) that leads out there. Where a piece is short it ends at a corner, which leaves room to those of others.
local function arrival(
  area: Area,
  corner: number,
  heading: number,
  crossing: boolean
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
  local function is_clear(at: number, apart: number): boolean
    return apart >= (if area.degree[at] == 2 then NEAR else FAR)
  end
  if is_clear(edge, before_it) and is_clear(after, behind_it) then
    return x, y, edge, areas.heading(area, edge) - 90
  end
  local ends = if before_it < behind_it then { edge, after } else { after, edge }
  for _, at in ends do
    local open, middle = areas.angle(area, at)
    local apart = math.min((at - corner) % area.count, (corner - at) % area.count)
    local is_free = area.degree[at] == 2 or crossing and area.degree[at] == 3
    if apart > 1 and open >= WIDE and open < 250 and is_free then
      local way = math.deg(math.atan2(area.y[at] - area.y[corner], area.x[at] - area.x[corner]))
      if math.abs(checks.between(way, middle + 180)) <= open / 2 - LEAST then
        return area.x[at], area.y[at], at, middle + 180
      end
    end
  end
  return nil, 0, 0, 0
end

-- The best of some streets that divide an area, as the corner that it leaves and its places; nil if there is none.
local function cut(area: Area, pattern: Pattern, limit: number, tries: number): (number?, { number }?)
  local size = math.sqrt(area.size)
  local least = math.max(pattern.least * pattern.least, 0.08 * math.min(limit, area.size))
  local best, start, way = math.huge, nil, nil
  local first, stride = math.floor(random() * area.count), math.max(1, area.count / STARTS)
  local crossing = random() < pattern.cross
  -- Parts differ, so that blocks do.
  local share = random(0.12, 0.5)
  -- What is not divided any more is the more crooked.
  local is_last = area.size < 3 * limit
  local piece = (if is_last then SHORT_PIECE else PIECE) + 3 * math.min(tries, 4)
  local bow = (if random() < 0.5 then 1 else -1) * random(0.3, 1) * pattern.bow * (if is_last then 1 else 0.4)
  for number = 0, math.min(STARTS, area.count) - 1 do
    local corner = 1 + math.floor(first + number * stride) % area.count
    local open, middle = areas.angle(area, corner)
    local degree = area.degree[corner]
    if open < WIDE or degree > 3 then
      continue
    end
    local cost = if degree == 3 then (if crossing then -0.3 else 3.5) elseif degree == 1 then -1 else 0
    for _, turn in TURNS do
      if math.abs(turn) > open / 2 - LEAST then
        continue
      end
      local x, y, edge, out = arrival(area, corner, middle + turn, crossing)
      if not x then
        continue
      end
      local dx, dy = x - area.x[corner], y - area.y[corner]
      local heading = math.deg(math.atan2(dy, dx))
      local off, turned = checks.between(heading, out), checks.between(middle, heading)
      local part = areas.part(area, corner, edge, x, y)
      part = math.min(part, area.size - part)
      if part < least or math.abs(off) > 42 or math.abs(turned) > open / 2 - LEAST then
        continue
      end
      local uneven = 2 * (share - part / area.size)
      local along = math.abs((heading - area.turned + 45) % 90 - 45)
      local total = cost
        + 1.1 * uneven * uneven
        + 0.55 * math.sqrt(dx * dx + dy * dy) / size
        + (off / 26) ^ 2
        + (turned / 30) ^ 2
        + along / 60
        + 0.35 * random()
      if total < best then
        best, start = total, corner
        local from = { area.x[corner], area.y[corner] }
        -- The corners of a wide street take more of what leaves it.
        local function ends(depth: number): number
          return if depth < 2 then piece + WIDER else piece
        end
        local pieces = { ends(area.depth[corner]), piece, ends(area.depth[edge]) }
        way = curve(from, { x, y }, heading - 0.5 * turned, heading + 0.7 * off, pieces, bow)
      end
    end
  end
  return start, way
end

local function join(way: { number }, rest: { number }): { number }
  return table.move(rest, 1, #rest, #way + 1, way)
end

-- A lane that ends within an area, most of them around a corner, as `cut` gives it.
local function lane(area: Area): (number?, { number }?)
  for _ = 1, 6 do
    local corner = 1 + math.floor(random() * area.count)
    local open, middle = areas.angle(area, corner)
    if open < WIDE or area.degree[corner] ~= 2 then
      continue
    end
    local x, y = area.x[corner], area.y[corner]
    local heading = middle + random(-10, 10)
    local long = math.min(areas.hit_from(area, x, y, heading) - APART, random(LANE[1], LANE[2]))
    if long < LANE[1] then
      continue
    end
    local to = { x + long * math.cos(math.rad(heading)), y + long * math.sin(math.rad(heading)) }
    if areas.ahead(area, to[1], to[2], heading) <= APART then
      continue
    end
    local way = curve({ x, y }, to, middle, heading, LANE_PIECES, 0)
    local side = if random() < 0.5 then 1 else -1
    for _, hand in { side, -side } do
      local turned = heading + hand * random(65, 95)
      local rest = random(0.6, 1.3) * long
      while rest > 26 do
        local east, north = math.cos(math.rad(turned)), math.sin(math.rad(turned))
        local ends = { to[1] + rest * east, to[2] + rest * north }
        if
          areas.ahead(area, ends[1], ends[2], turned) > APART
          and areas.hit_from(area, to[1], to[2], turned) > rest + APART
        then
          return corner, join(way, curve(to, ends, turned, turned, LANE_PIECES, 0))
        end
        rest -= 9
      end
    end
    return corner, way
  end
  return nil, nil
end

-- The heading (degrees) and the length (m) of the way to a place from a junction.
local function aim(this: Network, junction: number, x: number, y: number): (number, number)
  local from = this:place(junction)
  local dx, dy = x - from.x, y - from.y
  return math.deg(math.atan2(dy, dx)), math.sqrt(dx * dx + dy * dy)
end

-- The rules of division. `pattern_at` gives the pattern of a place, `room` the largest block (m²) there, or nil where land is not
-- divided, and `propose` proposes a street.
function division.rules(
  system: System<Network>,
  pattern_at: (x: number, y: number) -> Pattern,
  room: (pattern: Pattern, x: number, y: number) -> number?,
  deepest: number,
  propose: (
    network: Network,
    junction: number,
    heading: number,
    length: number,
    depth: number
  ) -> (),
  keeps: boolean
)
  system:rule("Land", function(this: Network)
    local modules, seen = {}, {}
    for junction, corner in this:places() do
      for _, heading in corner.headings do
        local face = this:face(junction, heading)
        local corners = face.corners
        local key = junction * 2 ^ 26 + corners[2 % #corners + (if #corners == 1 then 1 else 0)].junction
        if seen[key] then
          continue
        end
        for index, each in corners do
          seen[each.junction * 2 ^ 26 + corners[index % #corners + 1].junction] = true
        end
        if face.area > 0 then
          table.insert(modules, Quarter(junction, heading, 0))
        end
      end
    end
    if #modules == 0 then
      return nil
    end
    return table.unpack(modules)
  end)

  system:rule(
    "Quarter(junction, heading, tries)",
    function(this: Network, junction: number, heading: number, tries: number)
      local area = areas.read(this:face(junction, heading))
      if not area or tries >= (if area.size > LARGE then MORE_TRIES else TRIES) then
        return nil
      end
      local pattern = pattern_at(area.middle[1], area.middle[2])
      local limit = room(pattern, area.middle[1], area.middle[2])
      if not limit then
        return nil
      end
      local is_estate = tries == 0
        and area.size > 2500
        and area.size < 6 * limit
        and area.size < ESTATE
        and random() < pattern.gap
      if area.size > limit and not is_estate then
        local start, way = cut(area, pattern, limit, tries)
        if start and way then
          local depth = math.min(if area.size > math.max(6 * limit, STREET) then 1 else 2, deepest)
          return Cut(area.junction[start], way, depth, area.size, tries)
        end
        return Quarter(junction, heading, tries + 1)
      end
      if keeps and tries <= area.size / LANE_LAND and random() < pattern.stop then
        local start, way = lane(area)
        if start and way then
          return Lane(area.junction[start], way, math.min(2, deepest), tries)
        end
      end
      return nil
    end
  )

  system:rule(
    "Cut(junction, way, depth, area, tries)",
    function(this: Network, junction: number, way: { number }, _: number, size: number, tries: number)
      local heading = aim(this, junction, way[1], way[2])
      local first = this:arrived(junction, heading)
      if not first then
        return Quarter(junction, heading, tries + 1)
      end
      local face = this:face(junction, heading)
      if math.abs(face.area - size) < 1 then
        -- It was refused on the way, so that there is one area still.
        return Quarter(junction, heading, tries + 1)
      end
      return Quarter(junction, heading, 0), Quarter(first, heading + 180, 0)
    end
  )

  system:rule(
    "Lane(junction, way, depth, tries)",
    function(this: Network, junction: number, way: { number }, _: number, tries: number)
      return Quarter(junction, aim(this, junction, way[1], way[2]), tries + 1)
    end
  )

  -- Leads a street by places, as far as it is not refused and joins nothing.
  local function lead(this: Network, junction: number, way: { number }, depth: number)
    local at: number? = junction
    for index = 1, #way, 2 do
      local heading, length = aim(this, at :: number, way[index], way[index + 1])
      propose(this, at :: number, heading, length, depth)
      at = this:reached(at :: number, heading)
      if not at then
        return
      end
    end
  end
  system:interpret(
    "Cut(junction, way, depth, area, tries)",
    function(this: Network, junction: number, way: { number }, depth: number)
      lead(this, junction, way, depth)
    end
  )
  system:interpret(
    "Lane(junction, way, depth, tries)",
    function(this: Network, junction: number, way: { number }, depth: number)
      lead(this, junction, way, depth)
    end
  )
end

-- The module that begins it.
division.Land = Land

return division
