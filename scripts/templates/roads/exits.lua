--!strict
-- Exits: where main streets lead out of a town whose streets are there.
local checks = require("checks")

local exits = {}

export type Exits = {
  -- How many there are at most, spread around the town.
  count: number,
  -- How far (m) they lead beyond the line around all streets; or else where they end, straight across: how far (m) from the
  -- middle { 0, 0 }, or a convex polygon.
  length: number?,
  rim: (number | Geometry)?,
}

export type Exit = { junction: number, heading: number, length: number, pieces: number }

-- A street that leads out of the town: what is left of it (m), and in how many pieces.
local Exit = module("Exit", "junction", "heading", "rest", "pieces")

local KNOWN: { [string]: string } = { count = "number", length = "number", rim = "number or userdata" }

-- The pieces of an exit turn a little; choosing takes a step, and each piece one more.
local PIECES = 3
exits.STEPS = PIECES + 1
-- What is shorter (m) is straight.
local SHORT = 70
-- How far (degrees) an exit turns from the way straight out.
local MOST = 48
-- How much nearer (degrees) to straight out it would have to be to leave a street that is one deeper, and to leave square to
-- all streets in place of going on from one.
local DEEPER, ASIDE = 14, 12
-- How much of the detour of a joint is taken for one, for places that lie between those that are looked at.
local MARGIN = 0.94
-- How near to one another exits lie, as a share of what they would if they were spread evenly; the second where the first leaves
-- too few.
local SPREAD = { 0.62, 0.38 }

-- Refuses what no exits can be made of.
function exits.check(name: string, given: any, level: number)
  checks.options(name, given, KNOWN, level + 1)
  checks.number(`{name}: count`, given.count, 4, 0, 100, level + 1)
  if (given.length == nil) == (given.rim == nil) then
    error(`{name} have either a length or a rim`, level)
  end
end

-- How far (m) it is from a place to the rim.
local function rest_of_way(place: Vector, heading: number, rim: any): number
  local out = vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
  if type(rim) ~= "number" then
    local far = place + out * 100000
    return line({ { place.x, place.y }, { far.x, far.y } }):intersection(rim):length()
  end
  local along = place.x * out.x + place.y * out.y
  local off = place.x * place.x + place.y * place.y - along * along
  return math.sqrt(math.max(rim * rim - off, 0)) - along
end

-- The heading straight across the rim where one from a place comes to it.
local function across(place: Vector, heading: number, rim: any): number
  local function met(turn: number): Vector
    local way = math.rad(heading + turn)
    return place + vec(math.cos(way), math.sin(way), 0) * rest_of_way(place, heading + turn, rim)
  end
  local along = met(0.5) - met(-0.5)
  return math.deg(math.atan2(along.y, along.x)) - 90
end

type Piece = { number }

-- What a place is called; junctions and places where streets turn lie where their streets' points do.
local function key(x: number, y: number): string
  return `{x} {y}`
end

-- Whether two pieces, { x1, y1, x2, y2 }, cross.
local function crosses(one: Piece, other: Piece): boolean
  local function side(piece: Piece, x: number, y: number): boolean
    return (piece[3] - piece[1]) * (y - piece[2]) > (piece[4] - piece[2]) * (x - piece[1])
  end
  return side(one, other[1], other[2]) ~= side(one, other[3], other[4])
    and side(other, one[1], one[2]) ~= side(other, one[3], one[4])
end

-- Says whether the end of an exit might be joined to a street, as `join_dead_ends` does: for one that would be drawn back into the
-- town there is no gate.
local function joints(network: Network, join: number, detour: number): (exit: any, others: { any }) -> boolean
  local ways: { [string]: { any } } = {}
  local pieces: { Piece }, targets: { any } = {}, {}
  for _, street in network:streets() do
    local last = nil :: any
    for _, point in street.geometry.points do
      if last then
        table.insert(pieces, { last[1], last[2], point[1], point[2] })
        local length = math.sqrt((point[1] - last[1]) ^ 2 + (point[2] - last[2]) ^ 2)
        local here, there = key(last[1], last[2]), key(point[1], point[2])
        for from, to in { [here] = there, [there] = here } do
          ways[from] = ways[from] or {}
          table.insert(ways[from], { to = to, length = length })
        end
        local steps = math.max(1, math.ceil(length / 8))
        for step = 1, steps do
          local part = step / steps
          table.insert(targets, {
            x = lerp(last[1], point[1], part),
            y = lerp(last[2], point[2], part),
            ends = { { here, part * length }, { there, (1 - part) * length } },
          })
        end
      end
      last = point
    end
  end
  -- How far (m) the points of all streets are from one.
  local function reach(from: string): { [string]: number }
    local far: { [string]: number }, open: { string } = { [from] = 0 }, { from }
    while #open > 0 do
      local at = table.remove(open, 1) :: string
      for _, way in ways[at] or {} do
        local length = far[at] + way.length
        if length < (far[way.to] or math.huge) then
          far[way.to] = length
          local to: string = way.to
          table.insert(open, to)
        end
      end
    end
    return far
  end
  return function(exit: any, others: { any }): boolean
    local far = reach(exit.at)
    -- Whether a place so far (m) along the streets is joined to the end of an exit.
    local function joins(of: any, x: number, y: number, way: number): boolean
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
      for _, other in pieces do
        if crosses(piece, other) then
          return false
        end
      end
      return true
    end
    for _, target in targets do
      local way = math.huge
      for _, from in target.ends do
        way = math.min(way, (far[from[1]] or math.huge) + from[2])
      end
      if joins(exit, target.x, target.y, exit.length + way) then
        return true
      end
    end
    for _, other in others do
      local way = exit.length + (far[other.at] or math.huge)
      for part = 0.1, 1, 0.1 do
        local x, y = lerp(other.from.x, other.to.x, part), lerp(other.from.y, other.to.y, part)
        local here, there = lerp(exit.from.x, exit.to.x, part), lerp(exit.from.y, exit.to.y, part)
        if
          joins(exit, x, y, way + part * other.length)
          or joins(other, here, there, way - exit.length + other.length + part * exit.length)
        then
          return true
        end
      end
    end
    return false
  end
end

-- Exits of a network: the best of all junctions, away from one another. Main streets that go on come first.
local function choose(
  network: Network,
  options: Exits,
  join: number,
  detour: number,
  allowed: ((network: Network, from: Vector, to: Vector, depth: number) -> boolean)?
): { Exit }
  local corners: { [string]: { depth: number, arms: { number } } } = {}
  local places = {}
  for _, street in network:streets() do
    local points = street.geometry.points
    for index, point in points do
      local corner = corners[key(point[1], point[2])] or { depth = street.depth, arms = {} }
      corners[key(point[1], point[2])] = corner
      corner.depth = math.min(corner.depth, street.depth)
      for _, beside in { index - 1, index + 1 } do
        local next = points[beside]
        if next then
          table.insert(corner.arms, math.deg(math.atan2(next[2] - point[2], next[1] - point[1])))
        end
      end
      table.insert(places, { point[1], point[2] })
    end
  end
  if #places < 3 then
    return {}
  end
  local hull = line(places):convex_hull()
  local centre = hull:centroid()
  local middle = vec(centre:x(), centre:y(), 0)

  local found: { any } = {}
  local junction = 0
  -- Places where a street only turns have a number as junctions have, but network:junctions() leaves them out.
  while true do
    junction += 1
    local is_there, place = pcall(network.place, network, junction)
    if not is_there then
      break
    end
    local corner = corners[key(place.x, place.y)]
    local straight = math.deg(math.atan2(place.y - middle.y, place.x - middle.x))
    local function try(heading: number, score: number)
      local out = vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
      local length
      if options.rim then
        length = rest_of_way(place, heading, options.rim)
      else
        local far = place + out * 10000
        local within = line({ { place.x, place.y }, { far.x, far.y } }):intersection(hull)
        length = within:length() + (options.length :: number)
      end
      local to = place + out * length
      if length < 20 then
        return
      end
      local probe = network:probe(junction, heading, length, 0)
      local leads_there = probe.built and probe.place:distance(to) < 1
      if leads_there and not (allowed and not allowed(network, place, to, 0)) then
        table.insert(found, {
          junction = junction,
          at = key(place.x, place.y),
          from = place,
          to = to,
          heading = heading,
          length = length,
          pieces = if length < SHORT then 1 else PIECES,
          way = math.deg(math.atan2(to.y - middle.y, to.x - middle.x)),
          score = score + DEEPER * corner.depth,
        })
      end
    end
    -- What lies well inside has streets all around.
    if corner and place:distance(middle) > 0.3 * math.sqrt(hull:area()) then
      for turn = -MOST, MOST, MOST / 3 do
        try(straight + turn, math.abs(turn) + ASIDE)
      end
      for _, arm in corner.arms do
        local off = checks.between(straight, arm + 180)
        if math.abs(off) <= MOST then
          try(arm + 180, math.abs(off))
        end
      end
    end
  end
  table.sort(found, function(one: any, other: any)
    local left: { number } = { one.score, one.junction, one.heading }
    local right: { number } = { other.score, other.junction, other.heading }
    for index, number in left do
      if number ~= right[index] then
        return number < right[index]
      end
    end
    return false
  end)
  local chosen: { any } = {}
  local is_joined = joints(network, join, detour)
  for _, spread in SPREAD do
    for _, exit in found do
      local is_free = #chosen < options.count
      for _, other in chosen do
        local apart = math.abs(checks.between(exit.way, other.way))
        is_free = is_free and apart >= spread * 360 / options.count
      end
      if is_free and not is_joined(exit, chosen) then
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

-- The rules by which exits lead out.
function exits.rules(system: System<Network>, options: Exits)
  local rim = options.rim
  system:rule(
    "Exit(junction, heading, rest, pieces)",
    function(this: Network, junction: number, heading: number, rest: number, pieces: number)
      local at = this:reached(junction, heading)
      if not at or pieces == 1 then
        return nil
      end
      -- It swings a little, and keeps clear of its neighbours; the last piece leads straight across the rim.
      local left = rest - rest / pieces
      local place = this:place(at)
      local off = if rim then checks.between(heading, across(place, heading, rim)) else 0
      local turned = heading + off / (pieces - 1) + (if rim and pieces == 2 then 0 else random(-7, 7))
      return Exit(at, turned, if rim then rest_of_way(place, turned, rim) else left, pieces - 1)
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
