--!strict
-- Division: finer streets divide the land between main streets, until no block exceeds the maximum block at its
-- position.
local areas = require("areas")
local checks = require("checks")
local cuts = require("cuts")
local ways = require("ways")

local division = {}

type Pattern = any

-- The area on the left of the street that leaves a junction towards a heading (degrees): the number of failed
-- divisions, and its kind, from -1 for small blocks to 1 for large blocks.
local Quarter = module("Quarter", "junction", "heading", "tries", "kind")
-- A street through an area of a size (m²), from a junction through positions (m), x and y alternating; the outline of
-- the area has a heading (degrees) there.
local Cut = module("Cut", "junction", "way", "depth", "area", "along", "tries", "kind")
-- A lane that ends within a block.
local Lane = module("Lane", "junction", "way", "depth", "along", "lanes")
-- Divided land between streets, in which lanes end.
local Yard = module("Yard", "junction", "heading", "lanes")
-- Divides the land inside main streets, or adds lanes to divided land.
local Land = module("Land", "is_divided")
-- Land (m²) that could not be divided into its maximum block (m²), with its centre (m); it stays until growth ends.
local Undivided = module("Undivided", "area", "block", "x", "y")

division.GROWING = {
  "Land(is_divided)",
  "Yard(junction, heading, lanes)",
  "Quarter(junction, heading, tries, kind)",
  "Cut(junction, way, depth, area, along, tries, kind)",
  "Lane(junction, way, depth, along, lanes)",
}

-- The tries to divide an area before it stays as it is, and how many of them there are from the same corners.
local TRIES, ROUND = 12, 4
-- The tries of land that is much larger than its largest block.
local MANY = 32
-- From how many times its largest block land that could not be divided is reported, and its least area (m²).
local REPORTED, LARGE = 6, 20000
-- From how many blocks land is several quarters, and the least and the largest area (m²) of one.
local SEVERAL = 15
local LEAST, MOST = 16000, 80000
-- After how many tries a street may leave opposite another one.
local LATE = 8
-- The largest area (m²) that is left as it is for a park or an estate.
local ESTATE = 30000
-- The minimum area (m²) that a street divides, not a lane.
local STREET = 24000
-- The maximum area, in blocks, that an alley divides, and the maximum size (m²) of blocks with alleys.
local ALLEY, OLD = 10, 2500
-- The width (m) of greens.
local GREEN = { 17, 24 }
-- The minimum area (m²) with a green at its side.
local GREEN_LAND = 2500
-- The land (m²) per dead-end lane, and the maximum number of lanes of a block.
local LANE_LAND, LANES = 3000, 14
-- The length (m) of the boundary of a town per lane that is tried there.
local BORDER = 280

-- The rules of division. `pattern_at` gives the pattern of a place, `room` the largest block (m²) of a kind of quarter there, or nil
-- where land is not divided, `propose` proposes a street, `barriers` tell what streets do not cross, or are nil, and `outside` tells
-- whether lanes may lead to a place beyond the outline, or is false.
function division.rules(
  system: System<Network>,
  pattern_at: (x: number, y: number) -> Pattern,
  room: (pattern: Pattern, x: number, y: number, kind: number) -> number?,
  deepest: number,
  propose: any,
  sizes: any,
  barriers: any,
  outside: false | (x: number, y: number) -> boolean
)
  -- Tells if a street that leaves an area at a corner meets water or obstacles.
  local function meets_water(area: any, corner: number, way: { number }): boolean
    if barriers == nil then
      return false
    end
    local course: { number } = { area.x[corner], area.y[corner] }
    table.move(way, 1, #way, 3, course)
    return barriers.meets(course)
  end

  -- Tells if a street may leave an area at a corner; one that stays on land crosses no water.
  local function tester(
    this: Network,
    area: any,
    stays_on_land: boolean
  ): (number, { number }, number) -> boolean
    return function(corner, way, depth)
      local heading, length = ways.aim(this, area.junction[corner], way[1], way[2])
      if not this:probe(area.junction[corner], heading, length, depth).built then
        return false
      end
      return not (stays_on_land and meets_water(area, corner, way))
    end
  end

  system:rule("Land(is_divided)", function(this: Network, is_divided: boolean)
    local modules: { any } = {}
    for _, each in areas.faces(this) do
      local size: number = each.face.area
      if size > 0 and not is_divided then
        table.insert(modules, Quarter(each.junction, each.heading, 0, random(-1, 1)))
      elseif size > GREEN_LAND or size < 0 and is_divided and outside then
        table.insert(modules, Yard(each.junction, each.heading, 0))
      end
    end
    return checks.successor(modules)
  end)

  -- A street that divides an area, as `cuts.cut` gives it, and its depth.
  local function divide(
    this: Network,
    area: any,
    pattern: Pattern,
    limit: number,
    tries: number,
    is_large: boolean
  ): (number?, { number }?, number)
    local may_begin = tester(this, area, tries >= ROUND)
    -- A narrower street has room where a wider one has none.
    local depth = if tries >= 2 * TRIES
      then 3
      elseif tries < TRIES and area.size > math.max(6 * limit, STREET) then 1
      elseif area.size < ALLEY * limit and limit < OLD then 3
      else 2
    depth = math.min(depth, deepest, sizes.deepest)
    if depth == 2 and limit > OLD and tries == 0 and random() < (pattern.crescents or 0) then
      local wide = math.max(1.6 * sizes.near[depth], random(0.4, 1) * math.sqrt(limit))
      local start, way = cuts.crescent(sizes, area, wide, depth, may_begin)
      if start then
        return start, way, depth
      end
    end
    local crosses = random() < pattern.cross
      or tries >= LATE and (is_large or area.size > math.max(12 * limit, STREET))
    local candidates = cuts.candidates(sizes, area, pattern, limit, depth, crosses)
    for try = tries, if #candidates > 0 then tries + ROUND - 1 else tries - 1 do
      local start, way = cuts.cut(sizes, area, pattern, limit, depth, try, candidates, may_begin)
      if start then
        return start, way, depth
      end
    end
    return nil, nil, depth
  end

  system:rule(
    "Quarter(junction, heading, tries, kind)",
    function(this: Network, junction: number, heading: number, tries: number, kind: number)
      local area = areas.read(this:face(junction, heading))
      if not area or area.size <= 0 then
        return nil
      end
      local x, y = area.middle[1], area.middle[2]
      local pattern = pattern_at(x, y)
      -- Land that still consists of several quarters has no kind of its own.
      local own = kind
      local usual = room(pattern, x, y, 0)
      if usual and tries == 0 and area.size > math.clamp(SEVERAL * usual, LEAST, MOST) then
        own = random(-1, 1)
      end
      local limit = room(pattern, x, y, own)
      if not limit then
        return nil
      end
      -- Land that extends to a position with small blocks has smaller blocks.
      local least: number = limit
      for corner = 1, area.count, math.max(1, area.count // 6) do
        least = math.min(least, room(pattern, area.x[corner], area.y[corner], own) or least)
      end
      limit = math.sqrt(limit * least)
      local is_estate = tries == 0
        and area.size > 2500
        and area.size < 15 * limit
        and area.size < ESTATE
        and random() < pattern.gap
      local is_large = area.size > math.max(REPORTED * limit, LARGE)
      if tries >= (if is_large then MANY else TRIES) then
        -- A river, say, is no land that could be divided.
        local size: number = if barriers and is_large
          then areas.size_of(area, barriers.is_land)
          else area.size
        return if size > math.max(REPORTED * limit, LARGE) then Undivided(size, limit, x, y) else nil
      elseif
        area.size > math.max(limit, cuts.larger(limit) + pattern.least * pattern.least) and not is_estate
      then
        local start, way, depth = divide(this, area, pattern, limit, tries, is_large)
        if start and way then
          return Cut(area.junction[start], way, depth, area.size, areas.heading(area, start), tries, own)
        end
        return Quarter(junction, heading, tries + ROUND, own)
      end
      return nil
    end
  )

  -- A lane into the land around a town.
  local function lead_out(area: any): (number?, { number }?)
    local start, way = cuts.lane(sizes, area, 1)
    local is_inside = way ~= nil and (outside :: any)(way[#way - 1], way[#way])
    return if is_inside then start else nil, way
  end

  system:rule(
    "Yard(junction, heading, lanes)",
    function(this: Network, junction: number, heading: number, lanes: number)
      local area = areas.read(this:face(junction, heading))
      if not area then
        return nil
      end
      local pattern = pattern_at(area.middle[1], area.middle[2])
      local depth = math.min(2, deepest, sizes.deepest)
      local start, way
      local is_green = false
      if not pattern.room then
        return nil
      elseif area.size < 0 and lanes < areas.border(area) / BORDER then
        start, way = lead_out(area)
      elseif lanes == 0 and random() < (pattern.greens or 0) then
        local least = math.min(3, deepest, sizes.deepest)
        start, way = cuts.crescent(sizes, area, random(GREEN[1], GREEN[2]), least, tester(this, area, true))
        is_green = start ~= nil
        depth = if is_green then least else depth
      end
      if
        not start
        and area.size > 0
        and lanes < math.min(area.size / LANE_LAND, LANES)
        and random() < pattern.stop
      then
        start, way = cuts.lane(sizes, area, math.huge)
      end
      -- No bridge is built for a lane.
      if start and way and not meets_water(area, start, way) then
        local along = areas.heading(area, start)
        if is_green then
          -- The land continues outside of the green.
          along = ways.aim(this, area.junction[start], way[1], way[2])
        end
        return Lane(area.junction[start], way, depth, along, lanes)
      elseif area.size < 0 and lanes < areas.border(area) / BORDER then
        return Yard(junction, heading, lanes + 1)
      end
      return nil
    end
  )

  system:rule(
    "Cut(junction, way, depth, area, along, tries, kind)",
    function(
      this: Network,
      junction: number,
      way: { number },
      _: number,
      size: number,
      along: number,
      tries: number,
      kind: number
    )
      local heading = ways.aim(this, junction, way[1], way[2])
      local first = this:end_junction(junction, heading)
      if not first then
        return Quarter(junction, along, tries + 1, kind)
      end
      local face = this:face(junction, heading)
      if math.abs(face.area - size) < 1 then
        -- The street was refused on its way, so the area is not divided.
        return Quarter(junction, along, tries + 1, kind)
      end
      return Quarter(junction, heading, 0, kind), Quarter(first, heading + 180, 0, kind)
    end
  )

  system:rule(
    "Lane(junction, way, depth, along, lanes)",
    function(_: Network, junction: number, _: { number }, _: number, along: number, lanes: number)
      return Yard(junction, along, lanes + 1)
    end
  )

  system:interpret("Undivided(area, block, x, y)", function() end)
  local function lead(this: Network, junction: number, way: { number }, depth: number)
    ways.lead(this, junction, way, depth, propose)
  end
  system:interpret("Cut(junction, way, depth, area, along, tries, kind)", lead)
  system:interpret("Lane(junction, way, depth, along, lanes)", lead)
end

-- The module that begins the division.
division.Land = Land

return division
