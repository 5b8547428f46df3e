--!strict
-- Growth: the rules by which streets follow a pattern from junction to junction.
local checks = require("checks")
local country = require("country")
local division = require("division")
local exits = require("exits")
local gaps = require("gaps")
local greens = require("greens")
local highways = require("highways")
local mains = require("mains")
local options = require("options")
local reports = require("reports")

local growth = {}

-- A pattern of roads/patterns.
type Pattern = any

local number = checks.number

-- A tip grows a street from a junction towards a heading, with a length (m) and the depth of its path. It counts the
-- junctions since its last division, its refusals, and the remaining steps.
local Tip = module("Tip", "junction", "heading", "length", "depth", "run", "tries", "left")
-- A side street that leaves after some steps.
local Bud = module("Bud", "junction", "heading", "depth", "wait", "left")
-- A town that begins to grow after some steps.
local Town = module("Town", "junction", "wait", "left")
-- The open ends of existing streets.
local Outskirts = module("Outskirts")
-- Counts the steps, and cleans up after the last step.
local Clock = module("Clock", "left")
-- Waits until all modules before it have ended, and begins the next stage: outline, removal of open ends, division,
-- lanes.
local Watch = module("Watch", "stage")
-- The modules that it waits for.
local GROWING = {
  "Town(junction, wait, left)",
  "Outskirts",
  "Highway(junction, heading, length, goal, tries, left)",
  "Arrival(junction, heading, length, goal, tries)",
  "Tip(junction, heading, length, depth, run, tries, left)",
  "Bud(junction, heading, depth, wait, left)",
}
for _, stage in { mains.GROWING, country.GROWING, division.GROWING } do
  table.move(stage, 1, #stage, #GROWING + 1, GROWING)
end

-- The turns (degrees) of a refused main street, one attempt after the other.
local ASIDE = highways.ASIDE
-- The turns (degrees) of a side street that ends next to a junction, one attempt after the other.
local BESIDE = { 10, -10, 20, -20, 30, -30 }
-- The probability that a main street leaves the town; side streets never leave it.
local LEADS_OUT = 0.3
-- The number of steps that a side street waits, so that main streets come first.
local WAIT = 2
-- The number of steps that a town waits for highways.
local TOWN_WAIT = 4
-- The fractions of the remaining steps at which the script searches for land without streets.
local LATER = { 0.75, 0.6, 0.45, 0.3, 0.15 }
-- The maximum turn (degrees) of a main street to stay within a town, and the maximum turn of the same street.
local BORDER, SAME = 105, 50

-- A pseudo-random number from 0 to 1, the same for positions (m) within some metres.
local function drawn(x: number, y: number, seed: number): number
  local mixed =
    bit32.bxor(math.floor(x / 8 + 0.5) * 73856093 % 2 ^ 32, math.floor(y / 8 + 0.5) * 19349663 % 2 ^ 32, seed)
  mixed = bit32.bxor(mixed, bit32.rshift(mixed, 13)) % 65536
  return mixed * 40503 % 65536 / 65536
end

-- The system of `growth.system`, and its options with defaults. The script called `caller`, which errors name.
local function create(asked: any, caller: string): (System<Network>, any)
  -- The number of functions between this function and the script, for errors.
  local level = 4
  local of: any = options.read(asked, caller, level + 1)
  local pattern_at: (x: number, y: number) -> Pattern = of.pattern_at
  local inside: (x: number, y: number) -> boolean = of.inside
  local people: ((x: number, y: number) -> number)?, deepest: number = of.people, of.deepest
  local centres: { { number } }, headings: { number } = of.centres, of.headings
  local growing: number, keeps: boolean = of.growing, not of.removes
  local system: System<Network> = of.system
  local allowed: ((Network, Vector, Vector, number) -> boolean)? = of.allowed

  -- Proposes a street if it is allowed.
  local function propose(this: Network, junction: number, heading: number, length: number, depth: number)
    local from = this:place(junction)
    local way = length * vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
    if not allowed or allowed(this, from, from + way, depth) then
      this:grow(junction, heading, length, depth)
    end
  end

  -- The heading and the length (m) of a proposed street: a side street is extended to a target slightly beyond its
  -- end, and leads next to a junction of three instead of into it.
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
        if this:probe(junction, heading + turn, reach, depth).outcome == "joined" then
          return heading + turn, reach
        end
      end
    end
    return heading, if ahead.outcome == "joined" or ahead.outcome == "snapped" then reach else length
  end

  local field = math.floor(random() * 1000000)
  -- The tip of a street that leaves a junction; nil if the pattern omits the street.
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
    -- A side street that would leave the town ends within it, if it is long enough.
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
      -- Both ends compute the same result for the street between them. A street along the boundary of a town is never
      -- omitted.
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

  -- The main streets that continue from a junction in divided land; at the boundary of the town, they follow it.
  local function main(
    this: Network,
    pattern: Pattern,
    at: number,
    x: number,
    y: number,
    heading: number,
    run: number,
    left: number
  ): { any }
    local modules = {}
    local function lead(way: number, count: number)
      local length = pattern.length(x, y, way, 0)
      local aim = pattern.toward(x, y, way, length, 0)
      local function is_free(turn: number): boolean
        local east, north = math.cos(math.rad(aim + turn)), math.sin(math.rad(aim + turn))
        return inside(x + 1.3 * length * east, y + 1.3 * length * north)
      end
      -- A street that leaves another street keeps away from others, so that no streets run next to each other.
      local function has_room(turn: number): boolean
        local way = math.rad(aim + turn)
        local ahead = vec(x + 2.2 * length * math.cos(way), y + 2.2 * length * math.sin(way), 0)
        return this:distance(ahead) > 1.1 * length
      end
      if is_free(0) and (way == heading or has_room(0)) then
        table.insert(modules, Tip(at, aim, length, 0, count, 0, left))
        return
      end
      for turn = 15, BORDER, 15 do
        for _, side in { turn, -turn } do
          if is_free(side) and has_room(side) then
            table.insert(modules, Tip(at, aim + side, length, 0, 0, 0, left))
          end
        end
        if #modules > 0 and turn <= SAME then
          return
        end
      end
    end
    local divides = run >= pattern.every
    lead(heading, if divides then 0 else run + 1)
    if divides then
      local first = if random() < 0.5 then 90 else -90
      lead(heading + first, 0)
      if random() < pattern.both then
        lead(heading - first, 0)
      end
    end
    return modules
  end

  -- The modules that continue from a junction that a street has reached.
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
    if pattern.room then
      return if depth == 0 then main(this, pattern, at, x, y, heading, run, left) else {}
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
      -- Greens keep a distance. If dead ends are removed, only a part of some greens would remain.
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

  local looks = {}
  for _, share in LATER do
    looks[math.floor(growing * share)] = growing >= 8
  end

  -- A town around one centre has an outline.
  local has_outline = of.is_one and of.divides and not of.onto and #centres == 1
  -- Country roads and lanes leave the town, unless other streets lead out or dead ends are removed.
  local is_open = has_outline and keeps and not of.leads_out
  local lead_out: ((Network, number, { number }) -> { any })? = if has_outline
    then mains.rules(
      system,
      pattern_at(centres[1][1], centres[1][2]),
      inside,
      centres[1],
      propose,
      math.min(deepest, of.sizes.deepest)
    )
    else nil

  local axiom: { any } = if #centres > 1 then highways.axiom(centres, growing, caller, level) else {}
  local wait = if #axiom > 0 then TOWN_WAIT else 0
  if of.onto then
    table.insert(axiom, Outskirts())
  else
    for index in centres do
      table.insert(axiom, Town(index, wait, growing))
    end
  end
  table.insert(axiom, if of.is_one and of.divides then Watch(1) else Clock(growing))
  system:axiom(table.unpack(axiom))

  system:rule(
    "Town(junction, wait, left)",
    function(this: Network, junction: number, wait: number, left: number)
      if wait > 0 then
        return Town(junction, wait - 1, left - 1)
      end
      local place = this:place(junction)
      local pattern = pattern_at(place.x, place.y)
      local modules: { any } = if lead_out
        then lead_out(this, junction, asked.headings or mains.headings())
        else {}
      for _, heading in if lead_out then {} else headings do
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
        -- If only main streets grow, streets continue as main streets.
        local depth = if pattern.room then 0 else open.depth
        local tip = start(pattern, open.junction, open.place.x, open.place.y, open.heading, depth, 0, growing)
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
      local at = this:open_end(junction, heading)
      if at then
        local modules = onward(this, at, heading, depth, run, left - 1)
        if #modules == 0 and of.divides then
          return nil
        end
        return table.unpack(modules)
      end
      local crossed = this:end_junction(junction, heading)
      if crossed then
        local place = this:place(crossed)
        local pattern = pattern_at(place.x, place.y)
        local cross = if depth == 0 then math.max(pattern.cross, 0.2) else pattern.cross
        if inside(place.x, place.y) and random() < cross then
          return start(pattern, crossed, place.x, place.y, heading, depth, run, left - 1, #ASIDE)
        end
      elseif depth == 0 and tries < #ASIDE then
        -- A pattern of straight lines bends only for obstacles.
        local place, fate = this:place(junction), this:outcome(junction, heading)
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
      -- Another street can have joined it while it waited.
      if this:degree(junction) > 2 and random() > pattern.both then
        return nil
      end
      return start(pattern, junction, place.x, place.y, heading, depth, 0, left - 1)
    end
  )

  system:rule("Clock(left)", function(this: Network, left: number)
    if left == 0 then
      local leads = of.leads_out
      return checks.successor(
        if leads then exits.modules(this, leads, of.joint, of.detour, of.allowed) else {}
      )
    elseif left == 1 and of.divides then
      return division.Land(false), Watch(4)
    end
    local modules: { any } = if looks[left] then gaps.tips(this, of, start, left - 1) else {}
    -- Clean up after all others have grown.
    table.insert(modules, Clock(left - 1))
    return table.unpack(modules)
  end)

  for _, before in GROWING do
    system:rule(`{before} < Watch(stage)`, function() end)
  end
  system:rule("Watch(stage)", function(_, stage: number)
    if stage == 1 and has_outline then
      return mains.Outline(), Watch(2)
    elseif stage <= 2 and not of.onto then
      return mains.Trim(), Watch(3)
    elseif stage <= 3 then
      return division.Land(false), Watch(4)
    elseif stage == 4 and is_open then
      return country.Roads(), Watch(5)
    elseif stage <= 5 and keeps then
      return division.Land(true), Watch(6)
    end
    return Clock(0)
  end)

  greens.rules(system, function(this: Network, at: number, heading: number, depth: number, left: number)
    local place = this:place(at)
    return start(pattern_at(place.x, place.y), at, place.x, place.y, heading, depth, 1, left)
  end, propose)
  highways.rules(system, function(at: number, heading: number, wait: number, left: number)
    return Bud(at, heading, 1, wait, left)
  end, inside)
  if of.leads_out then
    exits.rules(system, of.leads_out)
  end
  if of.divides then
    mains.trims(system)
    division.rules(system, pattern_at, of.room, deepest, propose, of.sizes, of.barriers, is_open and inside)
  end
  if is_open then
    country.rules(system, inside, centres[1], propose, math.min(1, deepest))
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
      this:join_dead_ends(of.join, of.detour)
      if not keeps then
        this:remove_dead_ends()
      end
    end
  end)
  return system, of
end

-- A system whose network grows by a pattern; derive it to its end. Options: `pattern` (or a function from a position
-- to a pattern), fields of the `network`, the `extent` (m) from the centre or a function that tests if a position is
-- within, the `population` at a position from 0 to 1, `centres` that highways join, `headings` of the first streets,
-- `onto` true to grow from the open ends of existing streets, the `deepest` side streets, `join` (m) and `detour` for
-- dead ends, and `dead_ends`, which are "keep" or "remove" for the remaining dead ends. `exits` are streets that
-- leave the town at the end, which takes the last four steps; `allowed` tests if a street may be proposed.
function growth.system(asked: any): (System<Network>, number?)
  local system, of = create(asked, "roads.system")
  return system, if of.divides then nil else of.steps
end

-- Grows a network by a pattern: `roads.system`, derived.
function growth.grow(asked: any)
  local system, of = create(asked, "roads.grow")
  local derived = system:derive(if of.divides then nil else of.steps)
  reports.warn_of(derived, of)
  return derived
end

return growth
