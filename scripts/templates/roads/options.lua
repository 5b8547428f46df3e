--!strict
-- Options of a town's streets: the options of `roads.system`, checked, with defaults.
local checks = require("checks")
local cuts = require("cuts")
local exits = require("exits")
local patterns = require("patterns")

local options = {}

-- A pattern of roads/patterns.
type Pattern = any

local number = checks.number

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

-- The snap distance (m) of a street's end, and the distance (m) over which dead ends are joined, if neither pattern
-- nor script sets it.
local SNAP, JOIN = 14, 40
-- The width (m) of streets, their clearance (m) and the radius (m) of corners, if the network sets none.
local WIDTH, CLEARANCE, CORNER = 14, 6, 4
-- The street types, by depth.
options.STREETS = {
  { width = 24, lanes = 4, sidewalk = 4 },
  { width = 16, lanes = 2, parking = 2.2, sidewalk = 3 },
  { width = 11, lanes = 2, sidewalk = 2 },
}

-- An area as the network takes it; nil if the network leaves it out or refuses it.
local function area_of(given: any): any
  local is_list = type(given) == "table" and not (given.rings or given.points or given.geometry)
  local ok, made = pcall(if is_list then polygon else geometry, given)
  return if ok then made else nil
end

-- The areas that streets avoid, from the fields of a network; nil if there are none. `meets` is true for a way, positions (m) as x
-- and y in turn, that meets one of them; `is_land` is true for a position on land.
local function barriers(fields: any): any
  local shapes: { any } = {}
  for _, list in { fields.obstacles or {}, fields.water or {} } :: { any } do
    -- The network refuses anything else.
    for _, each in if type(list) == "table" then list else {} do
      local area = area_of(each)
      if area then
        table.insert(shapes, area)
      end
    end
  end
  local limit: any = if fields.limit then area_of(fields.limit) else nil
  if #shapes == 0 and not limit then
    return nil
  end
  return {
    meets = function(way: { number }): boolean
      local points: { { number } } = {}
      for index = 1, #way, 2 do
        table.insert(points, { way[index], way[index + 1] })
      end
      local course = line(points)
      for _, each in shapes do
        if course:intersects(each) then
          return true
        end
      end
      return limit ~= nil and not course:within(limit)
    end,
    is_land = function(x: number, y: number): boolean
      local place = point(x, y)
      for _, each in shapes do
        if place:intersects(each) then
          return false
        end
      end
      return limit == nil or place:within(limit)
    end,
  }
end

-- Reads the options of `caller`; errors are told `level` functions above.
function options.read(asked: any, caller: string, level: number): any
  checks.options(caller, asked, KNOWN, level)
  local given: any = asked.pattern or patterns.organic()
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
  local extent: any = asked.extent
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
  local people: ((number, number) -> number)? = asked.population
  local deepest = number(`{caller}: deepest`, asked.deepest, 4, 0, 20, level)
  local divides = is_by_place or given.room ~= nil
  local steps =
    number(`{caller}: steps`, asked.steps, if divides and not is_by_place then 10000 else 24, 1, 10000, level)
  if steps % 1 ~= 0 then
    error(`{caller}: steps must be a whole number, not {steps}`, level - 1)
  end
  local detour = number(`{caller}: detour`, asked.detour, 2.5, 1, 100, level)
  local dead_ends = asked.dead_ends or "keep"
  if dead_ends ~= "keep" and dead_ends ~= "remove" then
    error(`{caller}: dead_ends is "keep" or "remove", not "{dead_ends}"`, level - 1)
  end
  -- If dead ends are removed, streets are joined instead, or do not stop.
  local keeps = dead_ends == "keep"
  local usual_join = if is_by_place then JOIN else given.join or JOIN
  local join = number(`{caller}: join`, asked.join, if keeps then usual_join else 130, 0, 2000, level)
  local centres = asked.centres or { { 0, 0 } }
  local headings = asked.headings or { 8, 98, 188, 278 }
  if asked.onto then
    local of_network: any = asked.network
    if of_network == nil or of_network.existing == nil then
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
    { streets = options.STREETS, min_angle = 50, snap = if is_by_place then SNAP else given.snap or SNAP }
  for name, value in asked.network or {} do
    fields[name] = value
  end
  if asked.onto then
    fields.starts = fields.starts or {}
  elseif fields.starts then
    error(
      `{caller}: network has starts, but streets begin at centres: give centres = \{ \{ x, y } }`,
      level - 1
    )
  else
    fields.starts = centres
  end
  local leads_out = if asked.exits then exits.check(`{caller}: exits`, asked.exits, level) else nil
  -- Exits take the last steps.
  local growing = if leads_out then math.max(steps - exits.STEPS, 1) else steps
  local system = lsystem({ object = checks.construct(network, fields, level) :: Network })
  local widths = {}
  for index, street in fields.streets do
    widths[index] = street.width or WIDTH
  end
  local sizes = cuts.sizes(widths, fields.clearance or CLEARANCE, fields.corner or CORNER)
  local function room(pattern: Pattern, x: number, y: number, own: number): number?
    local of_pattern: ((number, number, number, number) -> number?)? = pattern.room
    if not of_pattern then
      return nil
    end
    local much = if people ~= nil
      then number("population of a place", people(x, y), 0, -math.huge, math.huge)
      else 1
    local far = math.huge
    for _, centre in centres do
      far = math.min(far, math.sqrt((x - centre[1]) ^ 2 + (y - centre[2]) ^ 2))
    end
    local reach = if type(extent) == "number" then extent else 2 * far
    local most: number? = of_pattern(x, y, far / reach, own)
    return if most and much > 0.02 then most / math.min(much, 1) else nil
  end
  return {
    pattern_at = pattern_at,
    is_one = not is_by_place,
    divides = divides,
    inside = inside,
    room = room,
    sizes = sizes,
    barriers = barriers(fields),
    people = people,
    deepest = deepest,
    growing = growing,
    steps = steps,
    join = join,
    detour = detour,
    removes = not keeps,
    centres = centres,
    headings = headings,
    leads_out = leads_out,
    joint = asked.join or JOIN,
    allowed = asked.allowed,
    onto = asked.onto,
    system = system,
  }
end

return options
