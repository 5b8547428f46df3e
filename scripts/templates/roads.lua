--!strict
-- Grows street networks: patterns that say where streets go, districts that mix them, highways that join centres, and
-- roads that are written as a word of characters.
--
--   local roads = require("templates/roads")
--   roads.grow({ pattern = roads.organic(), extent = 500 })
local roads = {}

export type Pattern = {
  -- The heading (degrees from east, counter-clockwise) of a street that leaves a place (m) about towards `heading`.
  toward: (x: number, y: number, heading: number, length: number, depth: number) -> number,
  -- How long (m) a street is that leaves a place, to the next junction.
  length: (x: number, y: number, heading: number, depth: number) -> number,
  -- How likely a side street leaves a junction, and how likely there is one on the other side as well.
  side: number,
  both: number,
  -- How likely a street that meets another goes on behind it.
  cross: number,
  -- How far (degrees) side streets turn from square.
  skew: number,
  -- How likely a small side street ends at a junction.
  stop: number,
  -- The share of places that side streets leave out, the same from both ends.
  gap: number,
  -- Every so many junctions a main street divides; 0 for never.
  every: number,
}

export type RoadOptions = {
  pattern: (Pattern | (x: number, y: number) -> Pattern)?,
  network: NetworkOptions?,
  extent: (number | (x: number, y: number) -> boolean)?,
  population: ((x: number, y: number) -> number)?,
  centres: { { number } }?,
  headings: { number }?,
  onto: boolean?,
  deepest: number?,
  steps: number?,
  join: number?,
  detour: number?,
  dead_ends: string?,
}

local KNOWN: { [string]: string } = {
  pattern = "table or function",
  network = "table",
  extent = "number or function",
  population = "function",
  centres = "table",
  headings = "table",
  onto = "boolean",
  deepest = "number",
  steps = "number",
  join = "number",
  detour = "number",
  dead_ends = "string",
}

-- Refuses what a table may not have.
local function check(name: string, given: { [string]: any }, known: { [string]: string })
  for key, value in given do
    local kinds = known[key]
    if not kinds then
      local names = {}
      for each in known do
        table.insert(names, each)
      end
      table.sort(names)
      error(`{name} has no option {key}; it has {table.concat(names, ", ")}`, 3)
    elseif not string.find(kinds, type(value), 1, true) then
      error(`{name}: {key} is a {type(value)}, and must be a {kinds}`, 3)
    end
  end
end

-- The number that an option has; refuses what is out of its range, in the line of whoever called the caller. (What takes
-- more arguments is not inlined, so that its caller can be told.)
local function number(
  name: string,
  value: any,
  usual: number,
  least: number,
  greatest: number,
  ...: number
): number
  local given = if value == nil then usual else value
  if type(given) ~= "number" or not (given >= least and given <= greatest) then
    error(`{name} must be a number from {least} to {greatest}, not {given}`, (...) or 3)
  end
  return given
end

-- Degrees from one heading to another, from -180 to 180.
local function between(from: number, to: number): number
  return (to - from + 180) % 360 - 180
end

-- The one of some headings that is nearest to another.
local function nearest(heading: number, headings: { number }): number
  local best = headings[1]
  for _, other in headings do
    if math.abs(between(heading, other)) < math.abs(between(heading, best)) then
      best = other
    end
  end
  return best
end

local PATTERN = {
  block = "number",
  width = "number",
  angle = "number",
  bends = "number",
  branching = "number",
  cross = "number",
  skew = "number",
  stop = "number",
  gap = "number",
  every = "number",
  middle = "table",
  steepest = "number",
}

-- Streets that wander, side streets that leave one at a time: a town that nobody planned. `block` (m) is how far
-- junctions are apart, `bends` how far (degrees) a street turns from one to the next, `branching` how many junctions
-- have side streets.
function roads.organic(options: { [string]: any }?): Pattern
  local of = options or {}
  check("roads.organic", of, PATTERN)
  local block = number("roads.organic: block", of.block, 80, 20, 500)
  local bends = number("roads.organic: bends", of.bends, 32, 0, 60)
  local field = math.floor(random() * 1000000)
  return {
    toward = function(x, y, heading, _, depth)
      -- Streets near one another turn alike; the smaller ones have a mind of their own.
      local common = noise(x / (block * 5), y / (block * 5), 0.5, field)
      local own = if depth == 0 then 0.15 else 0.5
      return heading + bends * (common + random(-own, own))
    end,
    length = function(x, y, _, depth)
      -- Quarters are closer here and wider there.
      local wide = math.clamp(math.exp(1.3 * noise(x / (block * 4), y / (block * 4), 7.5, field)), 0.4, 1.8)
      return block * wide * (if depth == 0 then 1 else random(0.55, 1.35))
    end,
    side = number("roads.organic: branching", of.branching, 0.9, 0, 1),
    both = 0.03,
    cross = number("roads.organic: cross", of.cross, 0.03, 0, 1),
    skew = number("roads.organic: skew", of.skew, 18, 0, 40),
    stop = number("roads.organic: stop", of.stop, 0.5, 0, 1),
    gap = number("roads.organic: gap", of.gap, 0, 0, 0.6),
    every = number("roads.organic: every", of.every, 4, 0, 100),
  }
end

-- Streets along two directions, with blocks of `block` by `width` (m), turned by `angle` (degrees).
function roads.raster(options: { [string]: any }?): Pattern
  local of = options or {}
  check("roads.raster", of, PATTERN)
  local block = number("roads.raster: block", of.block, 130, 20, 500)
  local width = number("roads.raster: width", of.width, 75, 20, 500)
  local angle = number("roads.raster: angle", of.angle, 0, -360, 360)
  local headings = { angle, angle + 90, angle + 180, angle + 270 }
  return {
    toward = function(_, _, heading)
      return nearest(heading, headings)
    end,
    length = function(_, _, heading)
      local along = math.abs(between(angle, heading)) % 180
      return if along < 45 or along > 135 then block else width
    end,
    side = number("roads.raster: branching", of.branching, 1, 0, 1),
    both = 1,
    cross = number("roads.raster: cross", of.cross, 0.9, 0, 1),
    skew = 0,
    stop = number("roads.raster: stop", of.stop, 0, 0, 1),
    gap = number("roads.raster: gap", of.gap, 0.4, 0, 0.6),
    every = number("roads.raster: every", of.every, 6, 0, 100),
  }
end

-- Rays out of a `middle` (m), and rings around it that are `block` (m) apart.
function roads.radial(options: { [string]: any }?): Pattern
  local of = options or {}
  check("roads.radial", of, PATTERN)
  local block = number("roads.radial: block", of.block, 90, 20, 500)
  local middle = of.middle or { 0, 0 }
  return {
    toward = function(x, y, heading, length)
      local dx, dy = x - middle[1], y - middle[2]
      local far = math.sqrt(dx * dx + dy * dy)
      if far < block / 2 then
        return heading
      end
      local ray = math.deg(math.atan2(dy, dx))
      -- Both ends of a street along a ring lie on it.
      local half = math.deg(math.asin(math.min(1, length / (2 * far))))
      return nearest(heading, { ray, ray + 180, ray + 90 + half, ray - 90 - half })
    end,
    length = function(x, y, heading)
      local dx, dy = x - middle[1], y - middle[2]
      local ray = math.deg(math.atan2(dy, dx))
      local across = math.abs(between(ray, heading)) % 180
      if across < 45 or across > 135 then
        -- To the next ring.
        local far = math.sqrt(dx * dx + dy * dy) / block
        local rest = if across < 45 then math.floor(far + 1.3) - far else far - math.ceil(far - 1.3)
        return block * math.max(0.4, rest)
      end
      return block
    end,
    side = number("roads.radial: branching", of.branching, 0.95, 0, 1),
    both = 0.9,
    cross = number("roads.radial: cross", of.cross, 0.5, 0, 1),
    skew = 0,
    stop = number("roads.radial: stop", of.stop, 0, 0, 1),
    gap = number("roads.radial: gap", of.gap, 0.22, 0, 0.6),
    every = number("roads.radial: every", of.every, 3, 0, 100),
  }
end

-- Streets along the lines of equal height, and others straight up and down where it is not steeper than `steepest`
-- (degrees); elsewhere they climb at a slant. `height` gives the height (m) of a place, as a terrain's does:
-- function(x, y) return land:height({ x, y }) end.
function roads.contours(height: (x: number, y: number) -> number, options: { [string]: any }?): Pattern
  local of = options or {}
  check("roads.contours", of, PATTERN)
  local block = number("roads.contours: block", of.block, 80, 20, 500)
  local steepest = number("roads.contours: steepest", of.steepest, 9, 1, 45)
  local most = math.tan(math.rad(steepest))
  return {
    toward = function(x, y, heading, length)
      local near = length / 4
      local east = (height(x + near, y) - height(x - near, y)) / (2 * near)
      local north = (height(x, y + near) - height(x, y - near)) / (2 * near)
      local slope = math.sqrt(east * east + north * north)
      if slope < 0.005 then
        return heading
      end
      local up = math.deg(math.atan2(north, east))
      -- How far from straight up a street turns, so that it climbs no more than it may.
      local slant = if slope > most then math.deg(math.acos(most / slope)) else 0
      local along = nearest(heading, { up + 90, up - 90 })
      -- The line bends: what the contour does at the end of the street counts half.
      local tx, ty = math.cos(math.rad(along)) * length, math.sin(math.rad(along)) * length
      local lost = height(x + tx, y + ty) - height(x, y)
      local bend = math.deg(math.atan2(lost / slope, length))
      along += if between(up, along) > 0 then bend else -bend
      local ways = { along, up + slant, up - slant, up + 180 + slant, up + 180 - slant }
      return nearest(heading, ways)
    end,
    length = function(_, _, _, depth)
      return block * (if depth == 0 then 1 else random(0.8, 1.2))
    end,
    side = number("roads.contours: branching", of.branching, 0.55, 0, 1),
    both = 0.15,
    cross = number("roads.contours: cross", of.cross, 0.2, 0, 1),
    skew = 0,
    stop = number("roads.contours: stop", of.stop, 0.15, 0, 1),
    gap = number("roads.contours: gap", of.gap, 0, 0, 0.6),
    every = number("roads.contours: every", of.every, 5, 0, 100),
  }
end

-- Streets that turn towards where more people live. `people` gives from 0 to 1 how many live at a place (m).
function roads.populous(people: (x: number, y: number) -> number, options: { [string]: any }?): Pattern
  local of = options or {}
  check("roads.populous", of, PATTERN)
  local block = number("roads.populous: block", of.block, 80, 20, 500)
  local bends = number("roads.populous: bends", of.bends, 20, 0, 60)
  return {
    toward = function(x, y, heading, length, depth)
      local best, most = heading, -1
      for try = -2, 2 do
        local turned = heading + try * bends / 2
        local way = math.rad(turned)
        local found = 0
        -- What is far off counts less.
        for far = 1, 4 do
          local reach = far * length * (if depth == 0 then 2 else 1)
          found += people(x + math.cos(way) * reach, y + math.sin(way) * reach) / far
        end
        if found > most * 1.001 then
          best, most = turned, found
        end
      end
      return best + random(-2, 2)
    end,
    length = function(x, y)
      return block * (1.5 - 0.8 * math.clamp(people(x, y), 0, 1)) * random(0.85, 1.15)
    end,
    side = number("roads.populous: branching", of.branching, 0.75, 0, 1),
    both = 0.25,
    cross = number("roads.populous: cross", of.cross, 0.25, 0, 1),
    skew = number("roads.populous: skew", of.skew, 6, 0, 40),
    stop = number("roads.populous: stop", of.stop, 0.1, 0, 1),
    gap = number("roads.populous: gap", of.gap, 0, 0, 0.6),
    every = number("roads.populous: every", of.every, 5, 0, 100),
  }
end

-- The pattern of each place, by the nearest of some districts: { at = { x, y }, pattern = ... }.
function roads.districts(
  districts: { { at: { number }, pattern: Pattern } }
): (x: number, y: number) -> Pattern
  if #districts == 0 then
    error("roads.districts takes one district or more: { at = { x, y }, pattern = ... }", 2)
  end
  return function(x, y)
    local best, least = districts[1], math.huge
    for _, district in districts do
      local dx, dy = x - district.at[1], y - district.at[2]
      local far = dx * dx + dy * dy
      if far < least then
        best, least = district, far
      end
    end
    return best.pattern
  end
end

-- A street grows at a tip: from a junction, towards a heading, with a length (m) and how often its way has branched off.
-- It counts its junctions since it divided, and how often it was refused.
local Tip = module("Tip", "junction", "heading", "length", "depth", "run", "tries")
-- Where a side street is to leave after some steps.
local Bud = module("Bud", "junction", "heading", "depth", "wait")
-- A highway on its way to the start with a number.
local Highway = module("Highway", "junction", "heading", "length", "goal", "tries")
-- The last stretch of a highway.
local Arrival = module("Arrival", "junction", "goal")
-- Where a town begins to grow after some steps.
local Town = module("Town", "junction", "wait")
-- The open ends of streets that were there before.
local Outskirts = module("Outskirts")
-- Counts the steps, and tidies up after the last.
local Clock = module("Clock", "left")

-- How far (degrees) a main street turns when it is refused, one try after the other.
local ASIDE = { 20, -40, 55, -70 }
-- What streets are made of, by depth.
local STREETS = {
  { width = 24, lanes = 4, sidewalk = 4 },
  { width = 16, lanes = 2, parking = 2.2, sidewalk = 3 },
  { width = 11, lanes = 2, sidewalk = 2 },
}
-- How likely a main street leads out of town; side streets never do.
local LEADS_OUT = 0.4
-- How many steps a side street waits, so that main streets come first.
local WAIT = 2

-- A number from 0 to 1 that looks drawn, and is the same for a place (m) within some metres.
local function drawn(x: number, y: number, seed: number): number
  local mixed =
    bit32.bxor(math.floor(x / 8 + 0.5) * 73856093 % 2 ^ 32, math.floor(y / 8 + 0.5) * 19349663 % 2 ^ 32, seed)
  mixed = bit32.bxor(mixed, bit32.rshift(mixed, 13)) % 65536
  return mixed * 40503 % 65536 / 65536
end

-- The pairs of centres that highways join: those in whose circle no third one lies.
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

-- A system whose network grows by a pattern; derive it by `steps`. Options: `pattern` (or a function of a place that
-- gives one), fields of the `network`, the `extent` (m) from the middle or a function that says whether a place is
-- within, the `population` of a place from 0 to 1, `centres` that highways join, `headings` of the first streets,
-- `onto` true to grow from the open ends of streets that are there, the `deepest` side streets, `join` (m) and `detour`
-- for dead ends, and `dead_ends`, which are what is left of them to "keep" or to "remove".
function roads.system(options: RoadOptions)
  check("roads.system", options :: any, KNOWN)
  local given: any = options.pattern or roads.organic()
  local pattern_at: (x: number, y: number) -> Pattern = if type(given) == "function"
    then given
    else function()
      return given
    end
  local extent: any = options.extent or 500
  local inside: (x: number, y: number) -> boolean = if type(extent) == "function"
    then extent
    else function(x, y)
      return x * x + y * y < extent * extent
    end
  local people = options.population
  local deepest = number("roads.system: deepest", options.deepest, 4, 0, 20)
  local steps = number("roads.system: steps", options.steps, 24, 1, 10000)
  local detour = number("roads.system: detour", options.detour, 2.5, 1, 100)
  local dead_ends = options.dead_ends or "keep"
  if dead_ends ~= "keep" and dead_ends ~= "remove" then
    error(`roads.system: dead_ends is "keep" or "remove", not "{dead_ends}"`, 2)
  end
  -- What is removed should rather have been joined, or not have stopped.
  local keeps = dead_ends == "keep"
  local join = number("roads.system: join", options.join, if keeps then 40 else 130, 0, 2000)
  local centres = options.centres or { { 0, 0 } }
  local headings = options.headings or { 8, 98, 188, 278 }

  local fields: any = { streets = STREETS, min_angle = 50, snap = 16 }
  for name, value in (options.network or {}) :: any do
    fields[name] = value
  end
  if options.onto then
    fields.starts = fields.starts or {}
  else
    fields.starts = centres
  end
  local system = lsystem({ object = network(fields) })

  local field = math.floor(random() * 1000000)
  -- The tip of a street that leaves a junction; nil where the pattern leaves it out.
  local function start(
    pattern: Pattern,
    at: number,
    x: number,
    y: number,
    heading: number,
    depth: number,
    run: number
  ): any
    local length = pattern.length(x, y, heading, depth)
    local aim = pattern.toward(x, y, heading, length, depth)
    local east, north = math.cos(math.rad(aim)) * length, math.sin(math.rad(aim)) * length
    if not inside(x + east, y + north) and (depth > 0 or random() > LEADS_OUT) then
      return nil
    elseif depth > 0 then
      -- Both ends find the same number for what lies between them.
      if drawn(x + east / 2, y + north / 2, field) < pattern.gap then
        return nil
      end
    end
    return Tip(at, aim, length, depth, run, 0)
  end

  -- The modules that go on from a junction that a street has come to.
  local function onward(this: Network, at: number, heading: number, depth: number, run: number): { any }
    local place = this:place(at)
    local x, y = place.x, place.y
    if not inside(x, y) then
      return {}
    end
    local pattern = pattern_at(x, y)
    local much = if people then math.clamp(people(x, y), 0, 1) else 1
    if depth > 0 and much <= 0.02 or keeps and depth > 1 and random() < pattern.stop then
      return {}
    end
    local function tip(aim: number, deep: number, count: number)
      return start(pattern, at, x, y, aim, deep, count)
    end
    local divides = depth == 0 and pattern.every > 0 and run >= pattern.every
    local modules = { tip(heading, depth, if divides then 0 else run + 1) }
    local first = if random() < 0.5 then 90 else -90
    if divides then
      table.insert(modules, tip(heading + first, 0, 0))
      if random() < pattern.both then
        table.insert(modules, tip(heading - first, 0, 0))
      end
    elseif depth < deepest and random() < pattern.side * much then
      table.insert(modules, Bud(at, heading + first + random(-pattern.skew, pattern.skew), depth + 1, WAIT))
      if random() < pattern.both then
        table.insert(modules, Bud(at, heading - first + random(-pattern.skew, pattern.skew), depth + 1, WAIT))
      end
    end
    return modules
  end

  local axiom = {}
  local highways = if #centres > 1 then joined(centres) else {}
  for _, pair in highways do
    local from, to = centres[pair[1]], centres[pair[2]]
    local heading = math.deg(math.atan2(to[2] - from[2], to[1] - from[1]))
    table.insert(axiom, Highway(pair[1], heading, 90, pair[2], 0))
  end
  if options.onto then
    table.insert(axiom, Outskirts())
  else
    for index in centres do
      table.insert(axiom, Town(index, if #highways > 0 then 4 else 0))
    end
  end
  table.insert(axiom, Clock(steps))
  system:axiom(table.unpack(axiom))

  system:rule("Town(junction, wait)", function(this: Network, junction: number, wait: number)
    if wait > 0 then
      return Town(junction, wait - 1)
    end
    local place = this:place(junction)
    local pattern = pattern_at(place.x, place.y)
    local modules = {}
    for _, heading in headings do
      table.insert(modules, start(pattern, junction, place.x, place.y, heading, 0, 0))
    end
    return table.unpack(modules)
  end)

  system:rule("Outskirts", function(this: Network)
    local modules = {}
    for _, open in this:open_ends() do
      if inside(open.place.x, open.place.y) then
        local pattern = pattern_at(open.place.x, open.place.y)
        local tip = start(pattern, open.junction, open.place.x, open.place.y, open.heading, open.depth, 0)
        table.insert(modules, tip)
      end
    end
    return table.unpack(modules)
  end)

  system:rule(
    "Tip(junction, heading, length, depth, run, tries)",
    function(
      this: Network,
      junction: number,
      heading: number,
      length: number,
      depth: number,
      run: number,
      tries: number
    )
      local at = this:reached(junction, heading)
      if at then
        return table.unpack(onward(this, at, heading, depth, run))
      end
      local crossed = this:arrived(junction, heading)
      if crossed then
        local place = this:place(crossed)
        local cross = pattern_at(place.x, place.y).cross
        if inside(place.x, place.y) and random() < (if depth == 0 then math.max(cross, 0.2) else cross) then
          local further = pattern_at(place.x, place.y).length(place.x, place.y, heading, depth)
          return Tip(crossed, heading, further, depth, run, #ASIDE)
        end
      elseif depth == 0 and tries < #ASIDE then
        return Tip(junction, heading + ASIDE[tries + 1], length, depth, run, tries + 1)
      end
      return nil
    end
  )

  system:rule(
    "Bud(junction, heading, depth, wait)",
    function(this: Network, junction: number, heading: number, depth: number, wait: number)
      if wait > 0 then
        return Bud(junction, heading, depth, wait - 1)
      end
      local place = this:place(junction)
      local pattern = pattern_at(place.x, place.y)
      -- Somebody else may have joined it while it waited.
      if this:degree(junction) > 2 and random() > pattern.both then
        return nil
      end
      return start(pattern, junction, place.x, place.y, heading, depth, 0)
    end
  )

  system:rule(
    "Highway(junction, heading, length, goal, tries)",
    function(this: Network, junction: number, heading: number, length: number, goal: number, tries: number)
      local at = this:arrived(junction, heading)
      if not at then
        return if tries < #ASIDE
          then Highway(junction, heading + ASIDE[tries + 1], length, goal, tries + 1)
          else nil
      elseif at == goal then
        return nil
      end
      local here, there = this:place(at), this:place(goal)
      local rest = here:distance(there)
      if rest < 1.6 * length then
        return Arrival(at, goal)
      end
      local straight = math.deg(math.atan2(there.y - here.y, there.x - here.x))
      -- A highway swings a little, and turns no more than it has to.
      local swing = 12 * noise(here.x / 300, here.y / 300)
      local turn = math.clamp(between(heading, straight + swing), -20, 20)
      local modules = { Highway(at, heading + turn, length, goal, 0) }
      if inside(here.x, here.y) and random() < 0.6 then
        local first = if random() < 0.5 then 90 else -90
        table.insert(modules, Bud(at, heading + first, 1, 3))
      end
      return table.unpack(modules)
    end
  )

  system:rule("Arrival", function()
    return nil
  end)

  system:rule("Clock(left)", function(_, left: number)
    return if left > 0 then Clock(left - 1) else nil
  end)

  system:interpret(
    "Tip(junction, heading, length, depth, run, tries)",
    function(this: Network, junction: number, heading: number, length: number, depth: number)
      this:grow(junction, heading, length, depth)
    end
  )
  system:interpret(
    "Highway(junction, heading, length, goal, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      this:grow(junction, heading, length, 0)
    end
  )
  system:interpret("Arrival(junction, goal)", function(this: Network, junction: number, goal: number)
    this:lead(junction, this:place(goal), 0)
  end)
  system:interpret("Clock(left)", function(this: Network, left: number)
    if left == 0 then
      this:join_dead_ends(join, detour)
      if dead_ends == "remove" then
        this:remove_dead_ends()
      end
    end
  end)
  return system
end

-- Grows a network by a pattern: `roads.system`, derived.
function roads.grow(options: RoadOptions)
  return roads.system(options):derive(options.steps or 24)
end

-- Roads that are written as a word of characters, which productions rewrite.
-- A symbol of a word: its character, the side that the next branch leaves to, and how often its road has branched off.
local Letter = module("Letter", "name", "side", "depth")
-- Turns to a side, 1 for left, at a branch.
local Branch = module("Branch", "side")
-- Tidies up.
local Tidy = module("Tidy")

local WORD = {
  axiom = "string",
  productions = "table",
  iterations = "number",
  bend = "number",
  branch = "number",
  split = "string",
  lengths = "table",
  heading = "number",
  network = "table",
  join = "number",
  detour = "number",
  dead_ends = "string",
}
local SYMBOLS = "F builds a street, + and - turn clockwise and back, [ and ] hold a branch, X only rewrites"
-- The most symbols that a word may have.
local LONGEST = 500000

-- A word as a list of characters and, for each branch, a list; refuses what cannot be read.
local function parsed(what: string, word: string, productions: { [string]: any }, ...: any): { any }
  local open: { { any } } = { {} }
  for place = 1, #word do
    local name = string.sub(word, place, place)
    if name == "[" then
      local branch: { any } = {}
      table.insert(open, branch)
    elseif name == "]" then
      local branch = table.remove(open)
      if #open == 0 then
        error(`roads.word: {what} "{word}" has a ] at {place} that closes no [`, 3)
      end
      table.insert(open[#open], branch)
    elseif string.find("F+-X", name, 1, true) or productions[name] then
      table.insert(open[#open], name)
    elseif not string.find(name, "%s") then
      error(
        `roads.word: {what} "{word}" has {name} at {place}, which is no symbol: {SYMBOLS}, and so do symbols with a production`,
        3
      )
    end
  end
  if #open > 1 then
    error(`roads.word: {what} "{word}" has {#open - 1} [ without a ]`, 3)
  end
  return open[1]
end

-- How often each symbol is in a word.
local function counted(tree: { any }, counts: { [string]: number })
  for _, item in tree do
    if type(item) == "table" then
      counted(item, counts)
    else
      counts[item] = (counts[item] or 0) + 1
    end
  end
  return counts
end

-- An angle (degrees) that does not lead a road back onto itself.
local function angle(name: string, value: any, usual: number, ...: any): number
  local given = number(`roads.word: {name}`, value, usual, -360, 360, 4)
  if given % 180 == 0 then
    error(`roads.word: a {name} of {given} degrees leads a road onto itself; give one between 0 and 180`, 3)
  end
  return given
end

-- A system whose network is built by a word, which `productions` rewrite `iterations` times: { X = "F[X]FX" }, or a list
-- of words of which one is drawn. F builds a street as long as `lengths` has it for its depth (m), + and - turn by `bend`
-- (degrees), [ remembers the place and the heading and leaves by `branch` (degrees), ] goes back there; what has no
-- production is copied. Branches leave by `split`: "symmetric" to the left, while the road itself turns as far to the
-- right; "alternate" to the left and to the right in turns; "plain" as + and - within them say.
function roads.word(options: { [string]: any })
  check("roads.word", options, WORD)
  local productions: { [string]: any } = options.productions or { X = { "F[X]F+X", "F[X]F-X", "F[X]FX" } }
  local iterations = number("roads.word: iterations", options.iterations, 6, 0, 30)
  local bend = angle("bend", options.bend, 20)
  local branch = angle("branch", options.branch, 90)
  local split = options.split or "alternate"
  if not table.find({ "symmetric", "alternate", "plain" }, split) then
    error(`roads.word: split is "symmetric", "alternate" or "plain", not "{split}"`, 2)
  end
  local lengths = options.lengths or { 110, 85, 70 }
  if #lengths == 0 then
    error("roads.word: lengths has no length; write lengths = { 110, 85 }", 2)
  end
  for depth, length in lengths do
    number(`roads.word: the length for depth {depth - 1}`, length, 80, 1, 10000)
  end
  local join = number("roads.word: join", options.join, 120, 0, 2000)
  local detour = number("roads.word: detour", options.detour, 2, 1, 100)
  local dead_ends = options.dead_ends or "keep"
  if dead_ends ~= "keep" and dead_ends ~= "remove" then
    error(`roads.word: dead_ends is "keep" or "remove", not "{dead_ends}"`, 2)
  end

  local trees: { [string]: { { any } } } = {}
  local growth: { [string]: { [string]: number } } = {}
  for name, words in productions do
    if type(name) ~= "string" or #name ~= 1 or name == "[" or name == "]" then
      error(`roads.word: a production of {name} cannot be: one character but a bracket is rewritten`, 2)
    end
    trees[name], growth[name] = {}, {}
    for _, word in if type(words) == "table" then words else { words } do
      local tree = parsed(`the production of {name},`, word, productions)
      table.insert(trees[name], tree)
      for symbol, count in counted(tree, {}) do
        growth[name][symbol] = math.max(growth[name][symbol] or 0, count)
      end
    end
    if #trees[name] == 0 then
      error(`roads.word: {name} has an empty list of productions`, 2)
    end
  end
  local axiom = parsed("the axiom", options.axiom or "X", productions)

  -- How long the word becomes at most is known before it is written.
  local counts = counted(axiom, {})
  for step = 1, iterations do
    local after: { [string]: number } = {}
    local all = 0
    for symbol, count in counts do
      for each, times in growth[symbol] or { [symbol] = 1 } do
        after[each] = (after[each] or 0) + count * times
        all += count * times
      end
    end
    counts = after
    if all > LONGEST then
      error(
        `roads.word: after {step} of {iterations} iterations the word may have {all} symbols, and the limit is {LONGEST}; iterate less often, or shorten the productions`,
        2
      )
    end
  end

  -- What branches off at a small angle is allowed to.
  local leaves = if split == "plain" then bend else branch
  local sharpest = math.min(leaves % 180, 180 - leaves % 180)
  local sharp = math.clamp(sharpest, 15, 50)
  local fields: any = { streets = STREETS, min_angle = sharp, snap = 25 }
  for name, value in options.network or {} do
    fields[name] = value
  end
  local system = lsystem({ object = network(fields), interpret = "last" })

  -- The modules of a word.
  local function modules(tree: { any }, side: number, depth: number): { any }
    local list: { any } = {}
    for _, item in tree do
      if type(item) == "table" then
        local inner = modules(item, -side, depth + 1)
        if split ~= "plain" then
          table.insert(inner, 1, Branch(side))
        end
        table.insert(list, inner)
        if split == "alternate" then
          side = -side
        elseif split == "symmetric" then
          table.insert(list, Branch(-side))
        end
      else
        table.insert(list, Letter(item, side, depth))
      end
    end
    return list
  end

  local chain = modules(axiom, 1, 0)
  table.insert(chain, 1, Branch(0))
  table.insert(chain, Tidy())
  system:axiom(table.unpack(chain))
  system:rule("Letter(name, side, depth)", function(_, name: string, side: number, depth: number)
    local words = trees[name]
    if not words then
      return Letter(name, side, depth)
    end
    local drawn = if #words > 1 then math.min(#words, 1 + math.floor(random() * #words)) else 1
    return table.unpack(modules(words[drawn], side, depth))
  end)

  local heading = number("roads.word: heading", options.heading, 90, -360, 360)
  system:interpret(
    "Letter(name, side, depth)",
    function(this: Network, name: string, _: number, depth: number)
      if name == "F" then
        this:walk(lengths[math.min(depth + 1, #lengths)])
      elseif name == "+" then
        this:turn(-bend)
      elseif name == "-" then
        this:turn(bend)
      end
    end
  )
  system:interpret("Branch(side)", function(this: Network, side: number)
    -- The first of all says where the road begins to lead.
    this:turn(if side == 0 then heading else side * branch)
  end)
  system:interpret("Tidy", function(this: Network)
    this:join_dead_ends(join, detour)
    if dead_ends == "remove" then
      this:remove_dead_ends()
    end
  end)
  return system
end

return roads
