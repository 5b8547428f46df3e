--!strict
-- Exits: main streets that leave a town with finished streets.
local checks = require("checks")

local exits = {}

export type Exits = {
  -- The maximum number of exits, spread around the town.
  count: number,
  -- The length (m) beyond the boundary of all streets; or their end, perpendicular to the rim: the distance (m) from
  -- the centre { 0, 0 }, or a convex polygon.
  length: number?,
  rim: any,
}

-- A street that leads out of the town, with its remaining length (m) and number of pieces.
local Exit = module("Exit", "junction", "heading", "rest", "pieces")

local KNOWN: { [string]: string } = { count = "number", length = "number", rim = "number or userdata" }

-- The pieces of an exit turn slightly. The choice takes a step, and each piece one more.
local PIECES = 3
exits.STEPS = PIECES + 1
-- An exit up to this length (m) is straight.
local SHORT = 70
-- The maximum angle (degrees) between an exit and the radial direction.
local MOST = 48
-- The advantage in angle (degrees) that is needed to leave a street that is one level deeper, and to leave
-- perpendicular to all streets instead of continuing one.
local DEEPER, ASIDE = 14, 12
-- The fraction of a joint's detour that counts as a detour, because positions between the tested positions count too.
local MARGIN = 0.94
-- The minimum distance of exits, as a fraction of even spacing; the second value applies if the first gives too few
-- exits.
local SPREAD = { 0.62, 0.38 }

-- The checked options of exits, with the points of a rim instead of its polygon.
function exits.check(name: string, given: any, level: number): Exits
  checks.options(name, given, KNOWN, level + 1)
  local count = checks.number(`{name}: count`, given.count, 4, 0, 100, level + 1)
  local length, rim = given.length, given.rim
  if (length == nil) == (rim == nil) then
    error(`{name} have either a length or a rim`, level)
  end
  if type(rim) == "userdata" then
    local area, hull = rim:area(), rim:convex_hull():area()
    if rim.kind ~= "polygon" or area <= 0 or hull - area > 1e-6 * hull then
      error(`{name}: rim must be a distance (m) or a convex polygon`, level)
    end
    rim = rim.rings[1]
  end
  return { count = count, length = length, rim = rim }
end

-- The distance (m) from a position to the rim: a distance from the centre, or the points of a convex polygon,
-- counter-clockwise.
local function rest_of_way(place: Vector, heading: number, rim: any): number
  local east, north = math.cos(math.rad(heading)), math.sin(math.rad(heading))
  if type(rim) == "number" then
    local along = place.x * east + place.y * north
    local off = place.x * place.x + place.y * place.y - along * along
    return math.sqrt(math.max(rim * rim - off, 0)) - along
  end
  -- The path is inside between its last entry across an edge and its first exit.
  local enters, leaves = 0, math.huge
  local last = rim[#rim]
  for _, point in rim do
    local dx, dy = point[1] - last[1], point[2] - last[2]
    local outward = dy * east - dx * north
    local beyond = dy * (place.x - last[1]) - dx * (place.y - last[2])
    if outward > 0 then
      leaves = math.min(leaves, -beyond / outward)
    elseif outward < 0 then
      enters = math.max(enters, -beyond / outward)
    elseif beyond > 0 then
      return 0
    end
    last = point
  end
  return math.max(leaves - enters, 0)
end

-- The heading perpendicular to the rim, where the heading from a position meets it.
local function across(place: Vector, heading: number, rim: any): number
  local function met(turn: number): Vector
    local way = math.rad(heading + turn)
    return place + vec(math.cos(way), math.sin(way), 0) * rest_of_way(place, heading + turn, rim)
  end
  local along = met(0.5) - met(-0.5)
  return math.deg(math.atan2(along.y, along.x)) - 90
end

type Piece = { number }

-- Tests if two pieces, { x1, y1, x2, y2 }, cross.
local function crosses(one: Piece, other: Piece): boolean
  local function side(piece: Piece, x: number, y: number): boolean
    return (piece[3] - piece[1]) * (y - piece[2]) > (piece[4] - piece[2]) * (x - piece[1])
  end
  return side(one, other[1], other[2]) ~= side(one, other[3], other[4])
    and side(other, one[1], one[2]) ~= side(other, one[3], one[4])
end

type Way = { to: number, length: number }
type Target = { x: number, y: number, ends: { { number } } }
-- The streets of a network as pieces, as paths from one junction to others, and as positions to which an exit can be
-- joined.
type Ways = { from: { { Way } }, pieces: { Piece }, targets: { Target } }

local function ways_of(network: Network): Ways
  local from: { { Way } }, pieces: { Piece }, targets: { Target } = {}, {}, {}
  local function lead(here: number, there: number, length: number)
    from[here] = from[here] or {}
    table.insert(from[here], { to = there, length = length })
  end
  local numbers: { [string]: number } = {}
  for number, corner in network:places() do
    numbers[`{corner.place.x} {corner.place.y}`] = number
  end
  for _, street in network:streets() do
    local last, here = nil :: any, 0
    for _, point in street.geometry.points do
      local there = numbers[`{point[1]} {point[2]}`]
      if last then
        local piece: Piece = { last[1], last[2], point[1], point[2] }
        table.insert(pieces, piece)
        local length = math.sqrt((point[1] - last[1]) ^ 2 + (point[2] - last[2]) ^ 2)
        lead(here, there, length)
        lead(there, here, length)
        local steps = math.max(1, math.ceil(length / 8))
        for step = 1, steps do
          local part = step / steps
          local ends: { { number } } = { { here, part * length }, { there, (1 - part) * length } }
          local target: Target =
            { x = lerp(last[1], point[1], part), y = lerp(last[2], point[2], part), ends = ends }
          table.insert(targets, target)
        end
      end
      last, here = point, there
    end
  end
  return { from = from, pieces = pieces, targets = targets }
end

-- The distances (m) of junctions from a junction along the streets.
local function reach(ways: Ways, from: number): { [number]: number }
  local far: { [number]: number }, open: { number }, next = { [from] = 0 }, { from }, 1
  while open[next] do
    local at = open[next]
    next += 1
    for _, way in ways.from[at] or {} do
      local length = far[at] + way.length
      if length < (far[way.to] or math.huge) then
        far[way.to] = length
        local to: number = way.to
        table.insert(open, to)
      end
    end
  end
  return far
end

-- Tests if the end of an exit can be joined to a street, as `join_dead_ends` does. An exit that would be joined back
-- to the town gets no gate.
local function joints(network: Network, join: number, detour: number): (exit: any, others: { any }) -> boolean
  local known: Ways? = nil
  -- Tests if a position at this distance (m) along the streets can be joined to the end of an exit.
  local function joins(of: any, x: number, y: number, way: number, ways: Ways): boolean
    local dx, dy = x - of.to.x, y - of.to.y
    local straight = math.sqrt(dx * dx + dy * dy)
    if straight < 1 or straight > join or way < MARGIN * detour * straight then
      return false
    end
    local back = checks.between(of.heading + 180, math.deg(math.atan2(dy, dx)))
    if math.abs(back) < 20 then
      return false
    end
    -- A street in between would be met first.
    local piece: Piece = { of.to.x, of.to.y, x - dx / straight, y - dy / straight }
    for _, other in ways.pieces do
      if crosses(piece, other) then
        return false
      end
    end
    return true
  end
  return function(exit: any, others: { any }): boolean
    -- Most exits end far from all streets, so the paths are computed only on demand.
    local is_near = network:distance(exit.to) <= join
    for _, other in others do
      for part = 0.1, 1, 0.1 do
        local there, here = other.from:lerp(other.to, part), exit.from:lerp(exit.to, part)
        is_near = is_near or there:distance(exit.to) <= join or here:distance(other.to) <= join
      end
    end
    if not is_near then
      return false
    end
    local ways = known or ways_of(network)
    known = ways
    local far = reach(ways, exit.junction)
    for _, target in ways.targets do
      local way = math.huge
      for _, from in target.ends do
        way = math.min(way, (far[from[1]] or math.huge) + from[2])
      end
      if joins(exit, target.x, target.y, exit.length + way, ways) then
        return true
      end
    end
    for _, other in others do
      local way = exit.length + (far[other.junction] or math.huge)
      for part = 0.1, 1, 0.1 do
        local there, here = other.from:lerp(other.to, part), exit.from:lerp(exit.to, part)
        if
          joins(exit, there.x, there.y, way + part * other.length, ways)
          or joins(other, here.x, here.y, way - exit.length + other.length + part * exit.length, ways)
        then
          return true
        end
      end
    end
    return false
  end
end

-- The exits of a network: the best of all junctions, away from each other. Continuations of main streets come first.
local function choose(
  network: Network,
  options: Exits,
  join: number,
  detour: number,
  allowed: ((network: Network, from: Vector, to: Vector, depth: number) -> boolean)?
): { any }
  local corners = network:places()
  local around = {}
  for _, corner in corners do
    if #corner.headings > 0 then
      table.insert(around, { corner.place.x, corner.place.y })
    end
  end
  if #around < 3 then
    return {}
  end
  local hull = line(around):convex_hull()
  local centre, inner = hull:centroid(), 0.3 * math.sqrt(hull:area())
  local middle = vec(centre:x(), centre:y(), 0)
  local rim, more = options.rim or hull.rings[1], options.length or 0

  local candidates: { any } = {}
  for junction, corner in corners do
    local place = corner.place
    local straight = math.deg(math.atan2(place.y - middle.y, place.x - middle.x))
    local deeper = DEEPER * corner.depth
    -- A position well inside the town has streets all around.
    if #corner.headings > 0 and place:distance(middle) > inner then
      for turn = -MOST, MOST, MOST / 3 do
        local score = math.abs(turn) + ASIDE + deeper
        table.insert(candidates, { junction = junction, heading = straight + turn, score = score })
      end
      for _, arm in corner.headings do
        local off = math.abs(checks.between(straight, arm + 180))
        if off <= MOST then
          table.insert(candidates, { junction = junction, heading = arm + 180, score = off + deeper })
        end
      end
    end
  end
  table.sort(candidates, function(one: any, other: any): boolean
    local score: number, other_score: number = one.score, other.score
    if score ~= other_score then
      return score < other_score
    end
    local number: number, other_number: number = one.junction, other.junction
    return number < other_number or number == other_number and (one.heading :: number) < other.heading
  end)

  -- The direction of an exit.
  local function aim(exit: any)
    exit.from = corners[exit.junction].place
    exit.length = rest_of_way(exit.from, exit.heading, rim) + more
    local out = vec(math.cos(math.rad(exit.heading)), math.sin(math.rad(exit.heading)), 0)
    exit.to = exit.from + out * exit.length
    exit.pieces = if exit.length < SHORT then 1 else PIECES
    exit.way = math.deg(math.atan2(exit.to.y - middle.y, exit.to.x - middle.x))
  end
  -- Tests if a street can be built in this way.
  local function leads_there(exit: any): boolean
    if exit.length < 20 then
      return false
    end
    local probe = network:probe(exit.junction, exit.heading, exit.length, 0)
    if not probe.built or probe.place:distance(exit.to) >= 1 then
      return false
    end
    return not allowed or allowed(network, exit.from, exit.to, 0)
  end
  local chosen: { any } = {}
  local is_joined = joints(network, join, detour)
  for _, spread in SPREAD do
    for _, exit in candidates do
      if #chosen >= options.count then
        return chosen
      end
      if not exit.to then
        aim(exit)
      end
      local is_free = true
      for _, other in chosen do
        local apart = math.abs(checks.between(exit.way, other.way))
        is_free = is_free and apart >= spread * 360 / options.count
      end
      if is_free and exit.leads == nil then
        exit.leads = leads_there(exit)
      end
      if is_free and exit.leads and not is_joined(exit, chosen) then
        table.insert(chosen, exit)
      end
    end
  end
  return chosen
end

-- The modules of the exits of a network.
function exits.modules(
  network: Network,
  options: Exits,
  join: number,
  detour: number,
  allowed: ((network: Network, from: Vector, to: Vector, depth: number) -> boolean)?
): { any }
  local modules = {}
  for _, exit in choose(network, options, join, detour, allowed) do
    table.insert(modules, Exit(exit.junction, exit.heading, exit.length, exit.pieces))
  end
  return modules
end

-- The rules of exits.
function exits.rules(system: System<Network>, options: Exits)
  local rim = options.rim
  system:rule(
    "Exit(junction, heading, rest, pieces)",
    function(this: Network, junction: number, heading: number, rest: number, pieces: number)
      local at = this:open_end(junction, heading)
      if not at or pieces == 1 then
        return nil
      end
      -- The exit winds slightly, and keeps clear of its neighbours; the last piece crosses the rim at a right angle.
      local left = rest - rest / pieces
      local place = this:place(at)
      local off = if rim then checks.between(heading, across(place, heading, rim)) else 0
      local turned = heading + off / (pieces - 1) + (if rim and pieces == 2 then 0 else random(-7, 7))
      local further = if rim then rest_of_way(place, turned, rim) else left
      -- A bridge can lead the street across the rim.
      return if further > 0 then Exit(at, turned, further, pieces - 1) else nil
    end
  )
  system:interpret(
    "Exit(junction, heading, rest, pieces)",
    function(this: Network, junction: number, heading: number, rest: number, pieces: number)
      this:grow(junction, heading, rest / pieces, 0)
    end
  )
end

return exits
