--!strict
-- Growth: the rules by which streets follow a pattern, from junction to junction.
local checks = require("checks")
local exits = require("exits")
local greens = require("greens")
local highways = require("highways")
local patterns = require("patterns")

local growth = {}

-- What the patterns of roads/patterns are.
type Pattern = any

local number = checks.number

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
  exits: { count: number?, length: number?, rim: (number | Geometry)? }?,
  allowed: ((network: Network, from: Vector, to: Vector, depth: number) -> boolean)?,
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
  exits = "table",
  allowed = "function",
}

-- A street grows at a tip: from a junction, towards a heading, with a length (m) and how often its way has branched off.
-- It counts its junctions since it divided, how often it was refused, and the steps that are left.
local Tip = module("Tip", "junction", "heading", "length", "depth", "run", "tries", "left")
-- Where a side street is to leave after some steps.
local Bud = module("Bud", "junction", "heading", "depth", "wait", "left")
-- Where a town begins to grow after some steps.
local Town = module("Town", "junction", "wait", "left")
-- The open ends of streets that were there before.
local Outskirts = module("Outskirts")
-- Counts the steps, and tidies up after the last.
local Clock = module("Clock", "left")

-- How far (degrees) a main street turns when it is refused, one try after the other.
local ASIDE = highways.ASIDE
-- What streets are made of, by depth.
growth.STREETS = {
  { width = 24, lanes = 4, sidewalk = 4 },
  { width = 16, lanes = 2, parking = 2.2, sidewalk = 3 },
  { width = 11, lanes = 2, sidewalk = 2 },
}
-- How far (degrees) a side street turns to end beside a junction, one try after the other.
local BESIDE = { 10, -10, 20, -20, 30, -30 }
-- How likely a main street leads out of town; side streets never do.
local LEADS_OUT = 0.3
-- How many steps a side street waits, so that main streets come first.
local WAIT = 2
-- How many steps a town waits while highways are on their way to it.
local TOWN_WAIT = 4
-- Which shares of the steps are left when it is looked for land that growth has not come to.
local LATER = { 0.75, 0.6, 0.45, 0.3, 0.15 }
-- How near (m) a junction draws a street's end, and how far dead ends are joined, where neither pattern nor script says it.
local SNAP, JOIN = 14, 40

-- A number from 0 to 1 that looks drawn, and is the same for a place (m) within some metres.
local function drawn(x: number, y: number, seed: number): number
  local mixed =
    bit32.bxor(math.floor(x / 8 + 0.5) * 73856093 % 2 ^ 32, math.floor(y / 8 + 0.5) * 19349663 % 2 ^ 32, seed)
  mixed = bit32.bxor(mixed, bit32.rshift(mixed, 13)) % 65536
  return mixed * 40503 % 65536 / 65536
end

-- A system whose network grows by a pattern; derive it by `steps`. Options: `pattern` (or a function of a place that
-- gives one), fields of the `network`, the `extent` (m) from the middle or a function that says whether a place is
-- within, the `population` of a place from 0 to 1, `centres` that highways join, `headings` of the first streets,
-- `onto` true to grow from the open ends of streets that are there, the `deepest` side streets, `join` (m) and `detour`
-- for dead ends, and `dead_ends`, which are what is left of them to "keep" or to "remove". `exits` are streets that lead out
-- of the town when all is done, which takes the last four of the steps; `allowed` says which streets may be proposed.
function growth.system(options: RoadOptions, ...: number)
  -- How many functions are called between this and the script, for errors.
  local level = 3 + ((...) or 0)
  -- What the script has called, for errors.
  local caller = if level > 3 then "roads.grow" else "roads.system"
  checks.options(caller, options :: any, KNOWN, level)
  local given: any = options.pattern or patterns.organic()
  local is_by_place = type(given) == "function"
  local pattern_at: (x: number, y: number) -> Pattern = if is_by_place
    then function(x, y)
      return patterns.check(`the pattern at {x}, {y}`, given(x, y), 3)
    end
    else function()
      return given
    end
  if not is_by_place then
    patterns.check(`{caller}: pattern`, given, level)
  end
  local extent: any = options.extent
  if type(extent) ~= "function" then
    extent = number(`{caller}: extent`, extent, 500, 1, 500000, level)
  end
  local inside: (x: number, y: number) -> boolean = if type(extent) == "function"
    then function(x, y)
      local is_inside = extent(x, y)
      if type(is_inside) ~= "boolean" then
        error(`the extent at {x}, {y} must be true or false, not {is_inside}`, 2)
      end
      return is_inside
    end
    else function(x, y)
      return x * x + y * y < extent * extent
    end
  local people = options.population
  local deepest = number(`{caller}: deepest`, options.deepest, 4, 0, 20, level)
  local steps = number(`{caller}: steps`, options.steps, 24, 1, 10000, level)
  if steps % 1 ~= 0 then
    error(`{caller}: steps must be a whole number, not {steps}`, level - 1)
  end
  local detour = number(`{caller}: detour`, options.detour, 2.5, 1, 100, level)
  local dead_ends = options.dead_ends or "keep"
  if dead_ends ~= "keep" and dead_ends ~= "remove" then
    error(`{caller}: dead_ends is "keep" or "remove", not "{dead_ends}"`, level - 1)
  end
  -- What is removed should rather have been joined, or not have stopped.
  local keeps = dead_ends == "keep"
  local usual_join = if is_by_place then JOIN else given.join or JOIN
  local join = number(`{caller}: join`, options.join, if keeps then usual_join else 130, 0, 2000, level)
  local centres = options.centres or { { 0, 0 } }
  local headings = options.headings or { 8, 98, 188, 278 }
  if options.onto then
    if not (options.network and options.network.existing) then
      error(`{caller}: onto = true takes streets that are there: network = \{ existing = ... }`, level - 1)
    end
  elseif #centres == 0 or #headings == 0 then
    error(
      `{caller}: centres and headings say where streets begin; leave them out, or give one or more`,
      level - 1
    )
  end
  for index, heading in headings do
    number(`{caller}: heading {index}`, heading, 0, -360000, 360000, level)
  end
  for index, centre in centres do
    checks.place(`{caller}: centre {index}`, centre, level)
  end

  local fields: any =
    { streets = growth.STREETS, min_angle = 50, snap = if is_by_place then SNAP else given.snap or SNAP }
  for name, value in (options.network or {}) :: any do
    fields[name] = value
  end
  if options.onto then
    fields.starts = fields.starts or {}
  elseif fields.starts then
    error(
      `{caller}: network has starts, but streets begin at centres: give centres = \{ \{ x, y } }`,
      level - 1
    )
  else
    fields.starts = centres
  end
  local leads_out = if options.exits then exits.check(`{caller}: exits`, options.exits, level) else nil
  local growing = if leads_out then math.max(steps - exits.STEPS, 1) else steps
  local allowed = options.allowed
  local system = lsystem({ object = checks.construct(network, fields, level) :: Network })

  -- Proposes a street if it may be.
  local function propose(this: Network, junction: number, heading: number, length: number, depth: number)
    local from = this:place(junction)
    local way = length * vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
    if not allowed or allowed(this, from, from + way, depth) then
      this:grow(junction, heading, length, depth)
    end
  end

  -- The heading and the length (m) of a street that is proposed: a side street leads on to what is a little beyond its end, and
  -- beside a junction of three rather than into it.
  local function aimed(
    this: Network,
    junction: number,
    heading: number,
    length: number,
    depth: number
  ): (number, number)
    local from = this:place(junction)
    local sight = pattern_at(from.x, from.y).sight
    if depth == 0 or not sight then
      return heading, length
    end
    local reach = length + sight
    local ahead = this:probe(junction, heading, reach, depth)
    if ahead.junction and this:degree(ahead.junction) > 2 then
      for _, turn in BESIDE do
        if this:probe(junction, heading + turn, reach, depth).fate == "joined" then
          return heading + turn, reach
        end
      end
    end
    return heading, if ahead.fate == "joined" or ahead.fate == "snapped" then reach else length
  end

  local field = math.floor(random() * 1000000)
  -- The tip of a street that leaves a junction; nil where the pattern leaves it out.
  local function start(
    pattern: Pattern,
    at: number,
    x: number,
    y: number,
    heading: number,
    depth: number,
    run: number,
    left: number,
    tries: number?
  ): any
    local closed: ((x: number, y: number, heading: number, length: number, depth: number) -> boolean)? =
      pattern.closed
    local length = pattern.length(x, y, heading, depth)
    if depth > 0 and run == 0 then
      length = math.max(length, pattern.least or 0)
    end
    local aim = pattern.toward(x, y, heading, length, depth)
    if not (length > 0 and length < 100000 and aim - aim == 0) then
      error(
        `a pattern gives a street of {length} m towards {aim} degrees at {x}, {y}; its length has to be above 0, and its heading finite`
      )
    end
    local east, north = math.cos(math.rad(aim)) * length, math.sin(math.rad(aim)) * length
    -- A side street that would leave the town ends within it, where it is long enough.
    local least = pattern.least
    if depth > 0 and least then
      local part: number = 1
      while part * length > 1.4 * least and not inside(x + part * east, y + part * north) do
        part -= 0.15
      end
      length, east, north = part * length, part * east, part * north
    end
    if not inside(x + east, y + north) and (depth > 0 or random() > LEADS_OUT) then
      return nil
    elseif depth > 0 then
      -- Both ends find the same for what lies between them; a street along the border of a town is never left out.
      local middle_x, middle_y = x + east / 2, y + north / 2
      local is_border = inside(middle_x - north, middle_y + east) ~= inside(middle_x + north, middle_y - east)
      if
        not is_border
        and (
          drawn(middle_x, middle_y, field) < pattern.gap
          or closed and closed(middle_x, middle_y, aim, length, depth)
        )
      then
        return nil
      end
    end
    return Tip(at, aim, length, depth, run, tries or 0, left)
  end

  -- The modules that go on from a junction that a street has come to.
  local function onward(
    this: Network,
    at: number,
    heading: number,
    depth: number,
    run: number,
    left: number
  ): { any }
    local place = this:place(at)
    local x, y = place.x, place.y
    if not inside(x, y) then
      return {}
    end
    local pattern = pattern_at(x, y)
    local much = if people
      then math.clamp(number("population of a place", people(x, y), 0, -math.huge, math.huge), 0, 1)
      else 1
    if depth > 0 and much <= 0.02 or keeps and depth > 1 and random() < pattern.stop then
      return {}
    end
    local function tip(aim: number, deep: number, count: number)
      return start(pattern, at, x, y, aim, deep, count, left)
    end
    local divides = depth == 0 and pattern.every > 0 and run >= pattern.every
    local modules = { tip(heading, depth, if divides then 0 else run + 1) }
    local first = if random() < 0.5 then 90 else -90
    if divides then
      table.insert(modules, tip(heading + first, 0, 0))
      if random() < pattern.both then
        table.insert(modules, tip(heading - first, 0, 0))
      end
    elseif depth >= deepest or random() >= pattern.side * much then
      return modules
    elseif keeps and run % 3 == 1 and random() < (pattern.greens or 0) then
      -- Greens lie apart; where dead ends are removed, one would be left of some.
      local fork = greens.fork(at, heading, if first > 0 then 1 else -1, depth, WAIT, left)
      table.insert(modules, fork)
    else
      table.insert(
        modules,
        Bud(at, heading + first + random(-pattern.skew, pattern.skew), depth + 1, WAIT, left)
      )
      if random() < pattern.both then
        table.insert(
          modules,
          Bud(at, heading - first + random(-pattern.skew, pattern.skew), depth + 1, WAIT, left)
        )
      end
    end
    return modules
  end

  -- Streets into land that growth, which chance may end early, has not come to.
  local function belated(this: Network, left: number): { any }
    local modules = {}
    -- Streets rather leave where one only turns, for that leaves no junction of four.
    for at, corner in this:places() do
      local place, degree = corner.place, #corner.headings
      local depth = math.min(corner.depth + 1, deepest)
      local pattern = pattern_at(place.x, place.y)
      -- How many lengths around a place nothing is to be: few for a dead end, more for a turn, so that gaps stay; a fourth
      -- street leaves a junction for much land alone, and for very much where streets leave one at a time.
      local free = if degree < 2 then 1.1 elseif degree == 2 then 2 elseif pattern.both > 0 then 2.2 else 6
      local room = math.max(3 - degree, 1)
      for turn = 0, 270, 90 do
        local heading = headings[1] + turn
        local length = pattern.length(place.x, place.y, heading, depth)
        local way = (free + 0.4) * length * vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
        local ahead = place + way
        local is_peopled = not people or (people :: any)(ahead.x, ahead.y) > 0.02
        if room > 0 and inside(ahead.x, ahead.y) and is_peopled and this:distance(ahead) > free * length then
          local tip = start(pattern, at, place.x, place.y, heading, depth, 0, left)
          room -= if tip then 1 else 0
          table.insert(modules, tip)
        end
      end
    end
    return modules
  end
  local looks = {}
  for _, share in LATER do
    looks[math.floor(growing * share)] = growing >= 8
  end

  local axiom: { any } = if #centres > 1 then highways.axiom(centres, growing, caller, level) else {}
  local wait = if #axiom > 0 then TOWN_WAIT else 0
  if options.onto then
    table.insert(axiom, Outskirts())
  else
    for index in centres do
      table.insert(axiom, Town(index, wait, growing))
    end
  end
  table.insert(axiom, Clock(growing))
  system:axiom(table.unpack(axiom))

  system:rule(
    "Town(junction, wait, left)",
    function(this: Network, junction: number, wait: number, left: number)
      if wait > 0 then
        return Town(junction, wait - 1, left - 1)
      end
      local place = this:place(junction)
      local pattern = pattern_at(place.x, place.y)
      local modules = {}
      for _, heading in headings do
        table.insert(modules, start(pattern, junction, place.x, place.y, heading, 0, 0, left - 1))
      end
      return table.unpack(modules)
    end
  )

  system:rule("Outskirts", function(this: Network)
    local modules = {}
    for _, open in this:open_ends() do
      if inside(open.place.x, open.place.y) then
        local pattern = pattern_at(open.place.x, open.place.y)
        local tip =
          start(pattern, open.junction, open.place.x, open.place.y, open.heading, open.depth, 0, growing)
        table.insert(modules, tip)
      end
    end
    return table.unpack(modules)
  end)

  system:rule(
    "Tip(junction, heading, length, depth, run, tries, left)",
    function(
      this: Network,
      junction: number,
      heading: number,
      length: number,
      depth: number,
      run: number,
      tries: number,
      left: number
    )
      if left <= 0 then
        return nil
      end
      local at = this:reached(junction, heading)
      if at then
        return table.unpack(onward(this, at, heading, depth, run, left - 1))
      end
      local crossed = this:arrived(junction, heading)
      if crossed then
        local place = this:place(crossed)
        local pattern = pattern_at(place.x, place.y)
        local cross = pattern.cross
        if inside(place.x, place.y) and random() < (if depth == 0 then math.max(cross, 0.2) else cross) then
          return start(pattern, crossed, place.x, place.y, heading, depth, run, left - 1, #ASIDE)
        end
      elseif depth == 0 and tries < #ASIDE then
        -- A pattern of straight lines gives way to obstacles alone.
        local place, fate = this:place(junction), this:fate(junction, heading)
        local is_free = fate ~= "obstacle" and fate ~= "outside" and fate ~= "unknown"
        if not is_free or not pattern_at(place.x, place.y).straight then
          return Tip(junction, heading + ASIDE[tries + 1], length, depth, run, tries + 1, left - 1)
        end
      end
      return nil
    end
  )

  system:rule(
    "Bud(junction, heading, depth, wait, left)",
    function(this: Network, junction: number, heading: number, depth: number, wait: number, left: number)
      if left <= 0 then
        return nil
      elseif wait > 0 then
        return Bud(junction, heading, depth, wait - 1, left - 1)
      end
      local place = this:place(junction)
      local pattern = pattern_at(place.x, place.y)
      -- Somebody else may have joined it while it waited.
      if this:degree(junction) > 2 and random() > pattern.both then
        return nil
      end
      return start(pattern, junction, place.x, place.y, heading, depth, 0, left - 1)
    end
  )

  system:rule("Clock(left)", function(this: Network, left: number)
    if left == 0 then
      local modules = if leads_out
        then exits.modules(this, leads_out, options.join or JOIN, detour, allowed)
        else {}
      return table.unpack(modules)
    end
    local modules: { any } = if looks[left] then belated(this, left - 1) else {}
    -- It tidies up when all others have grown.
    table.insert(modules, Clock(left - 1))
    return table.unpack(modules)
  end)

  greens.rules(system, function(this: Network, at: number, heading: number, depth: number, left: number)
    local place = this:place(at)
    return start(pattern_at(place.x, place.y), at, place.x, place.y, heading, depth, 1, left)
  end, propose)
  highways.rules(system, function(at: number, heading: number, wait: number, left: number)
    return Bud(at, heading, 1, wait, left)
  end, inside)
  if leads_out then
    exits.rules(system, leads_out)
  end

  system:interpret(
    "Tip(junction, heading, length, depth, run, tries, left)",
    function(this: Network, junction: number, heading: number, length: number, depth: number)
      local aim, reach = aimed(this, junction, heading, length, depth)
      propose(this, junction, aim, reach, depth)
    end
  )
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
function growth.grow(options: RoadOptions)
  return growth.system(options, 1):derive(options.steps or 24)
end

return growth
