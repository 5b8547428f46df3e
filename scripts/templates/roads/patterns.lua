--!strict
-- Patterns: street directions as functions of a position, and probabilities.
local checks = require("checks")
local pattern = require("pattern")

local patterns = {}

-- A pattern of roads/pattern.
type Pattern = any

local between, nearest, number = checks.between, checks.nearest, checks.number
local KNOWN, drawn = pattern.KNOWN, pattern.drawn
patterns.check = pattern.check

-- An unplanned town: main streets lead out of the centre, or out of a `middle` (m) and around it if there are several
-- centres, and finer streets and lanes divide the land between them. `block` (m) is the width of blocks, `bends` the
-- maximum turn (degrees) of main streets, `cross` the fraction of streets that leave opposite another street, `stop`
-- the fraction of dead-end lanes of those with room, `greens` the fraction of small greens, and `gap` the fraction of
-- blocks that remain parks or estates. `variety` from 0 to 1 scales the differences between blocks: blocks are small
-- in the centre and large at the boundary, and quarters have their own sizes.
function patterns.organic(options: { [string]: any }?): Pattern
  local of: { [string]: any } = options or {}
  checks.options("roads.organic", of, KNOWN)
  local block = number("roads.organic: block", of.block, 80, 20, 500)
  local bends = number("roads.organic: bends", of.bends, 38, 0, 60)
  local variety = number("roads.organic: variety", of.variety, 1, 0, 1)
  local middle = checks.place("roads.organic: middle", of.middle or { 0, 0 })
  local field = math.floor(random() * 1000000)
  local usual = { branching = 0, both = 0.1, cross = 0.01, stop = 1, gap = 0.3, greens = 0.85, every = 8 }
  return pattern.make("roads.organic", of, usual, {
    least = math.max(0.2 * block, 14),
    bow = bends / 125,
    crescents = bends / 42,
    -- Streets are not moved to a nearby junction, and dead ends are not joined.
    snap = 7,
    join = 30,
    toward = function(x: number, y: number, heading: number, length: number): number
      local dx, dy = x - middle[1], y - middle[2]
      if dx * dx + dy * dy < length * length then
        return heading
      end
      -- Out of the centre or around it, as far as hills and obstacles allow.
      local turned = math.deg(math.atan2(dy, dx)) + 70 * noise(x / (block * 6), y / (block * 6), 2.5, field)
      local aim = nearest(heading, { turned, turned + 90, turned + 180, turned + 270 })
      local own = noise(x / (block * 2.5), y / (block * 2.5), 0.5, field)
      return heading + 0.35 * between(heading, aim) + bends * 0.6 * own
    end,
    length = function(): number
      return math.max(0.55 * block, 36)
    end,
    -- Blocks are small in the centre and grow outwards, where quarters differ more.
    room = function(_: number, _: number, far: number, own: number): number
      local along = math.clamp((far - 0.25) / 0.16, 0, 1)
      local rise = along * along * (3 - 2 * along)
      local kind = math.sign(own) * math.abs(own) ^ 0.6
      local wide = 6.5 * rise - 2.6 + kind * (if kind > 0 then 2.6 else 1.4 + 0.8 * rise)
      return math.clamp(1.4 * block * block * math.exp(variety * wide), 0.08 * block * block, 140000)
    end,
  })
end

-- The number of blocks of a raster in a row and in a column that form one block, and the fraction of such blocks.
local LARGE = { { 5, 0.06 }, { 3, 0.1 }, { 2, 0.14 } }
-- The minimum width (m) of the parts of a block that alleys divide.
local PART = 27
-- The maximum distance (m) of a street from a line that it follows.
local NEAR = 12

-- The positions (m) of the lines of a raster along one of its directions, on both sides of its centre, about `apart`:
-- most of them nearer, and a few farther apart.
local function lines(apart: number, variety: number, seed: number): { number }
  local at = { 0 }
  for index = 1, 150 do
    at[index + 1] = at[index] + apart * (1 + variety * (1.4 * drawn(index, 1, seed) ^ 2.2 - 0.3))
  end
  local all = {}
  for index = 150, 1, -1 do
    table.insert(all, -at[index + 1])
  end
  return table.move(at, 1, #at, #all + 1, all)
end

-- The number of elements of an increasing list that are not greater than a value.
local function below(numbers: { number }, limit: number): number
  local low, high = 0, #numbers
  while low < high do
    local middle = (low + high + 1) // 2
    if numbers[middle] <= limit then
      low = middle
    else
      high = middle - 1
    end
  end
  return low
end

-- Streets along two directions, with blocks of about `block` by `width` (m), rotated by `angle` (degrees). `gap` is
-- the fraction of streets across the longer direction that are omitted, and `variety` from 0 to 1 is the variation of
-- blocks: some are as large as several blocks, and alleys divide the blocks of old quarters.
function patterns.raster(options: { [string]: any }?): Pattern
  local of: { [string]: any } = options or {}
  checks.options("roads.raster", of, KNOWN)
  local block = number("roads.raster: block", of.block, 130, 20, 500)
  local width = number("roads.raster: width", of.width, 75, 20, 500)
  local angle = number("roads.raster: angle", of.angle, 0, -360, 360)
  local variety = number("roads.raster: variety", of.variety, 1, 0, 1)
  local gap = number("roads.raster: gap", of.gap, 0.6, 0, 0.6)
  local headings = { angle, angle + 90, angle + 180, angle + 270 }
  local field = math.floor(random() * 1000000)
  local columns, rows = lines(block, variety, field), lines(width, variety, field + 1)
  local east, north = math.cos(math.rad(angle)), math.sin(math.rad(angle))
  -- The number of the large block that contains a block; none if the block is not in a large block.
  local function large(column: number, row: number): number?
    for _, kind in LARGE do
      local size, share = kind[1], kind[2] * variety
      local a, b = column // size, row // size
      if drawn(a, b, field + size) < share then
        return (a * 1000 + b) * 10 + size
      end
    end
    return nil
  end
  -- Tests if two adjacent blocks are one: as parts of a large block, or as a pair across the longer direction.
  -- Streets that lead to a large block end at a street.
  local function is_one(column: number, row: number, along: boolean): boolean
    local here = large(column, row)
    local there = if along then large(column, row - 1) else large(column - 1, row)
    if here ~= there or here or along then
      return here == there and here ~= nil
    end
    -- Of adjacent streets, the street with the greatest number stays, so that no long row lacks streets.
    local own = drawn(column, row, field)
    return own < gap and (own < drawn(column - 1, row, field) or own < drawn(column + 1, row, field))
  end
  -- The positions (m) of alleys in a block of an old quarter, across the columns or across the rows; alleys of
  -- adjacent blocks rarely meet.
  local function alleys(column: number, row: number, along: boolean): { number }
    -- The minimum noise of an old quarter; noise is never above 1.
    local old = 0.2 + 3 * (1 - variety)
    local west, south = columns[column], rows[row]
    local far_east, far_north = columns[column + 1], rows[row + 1]
    if old > 1 or not (west and south and far_east and far_north) or large(column, row) then
      return {}
    end
    local at = { (west + far_east) / 2 / (block * 3), (south + far_north) / 2 / (block * 3) }
    if noise(at[1], at[2], 5.5, field) < old then
      return {}
    end
    local first, last = if along then west else south, if along then far_east else far_north
    local most = if along then 4 else 2
    local parts =
      math.min((last - first) // PART, 1 + math.floor(most * drawn(column, row, field + 6 + most)))
    local found = {}
    for part = 1, parts - 1 do
      table.insert(found, first + (last - first) * part / parts)
    end
    return found
  end
  -- The distance (m) from a position to the next line or alley along the columns or the rows; main streets ignore
  -- alleys.
  local function next_line(at: number, aside: number, along: boolean, forth: boolean, depth: number): number
    local crossed, beside = if along then columns else rows, if along then rows else columns
    -- A line that is near is behind.
    local near = 0.2 * if along then block else width
    local index = if forth then below(crossed, at + near) + 1 else below(crossed, at - near)
    local found = crossed[index]
    if not found or depth == 0 then
      return found or at + (if forth then 1 else -1) * (if along then block else width)
    end
    local cell = if forth then index - 1 else index
    for side = -1, 1, 2 do
      local other = below(beside, aside + side * NEAR)
      for _, alley in alleys(if along then cell else other, if along then other else cell, along) do
        local ahead = if forth then alley - at else at - alley
        if ahead > NEAR and ahead < math.abs(found - at) then
          found = alley
        end
      end
    end
    return found
  end
  local usual = { branching = 1, both = 1, cross = 1, stop = 0, gap = 0, every = 6 }
  return pattern.make("roads.raster", of, usual, {
    gap = 0,
    straight = true,
    toward = function(_: number, _: number, heading: number): number
      return nearest(heading, headings)
    end,
    length = function(x: number, y: number, heading: number, depth: number): number
      local turned = between(angle, heading) % 360
      local along = turned < 45 or turned > 315 or math.abs(turned - 180) < 45
      local forth = turned < 45 or turned > 315 or math.abs(turned - 90) < 45
      local u, v = x * east + y * north, y * east - x * north
      local at, aside = if along then u else v, if along then v else u
      return math.abs(next_line(at, aside, along, forth, depth) - at)
    end,
    closed = function(x: number, y: number, heading: number): boolean
      local turned = between(angle, heading) % 180
      local along = turned < 45 or turned > 135
      local u, v = x * east + y * north, y * east - x * north
      local column = below(columns, if along then u else u + NEAR)
      local row = below(rows, if along then v + NEAR else v)
      local aside = if along then v else u
      local function has_alley(ahead: number): boolean
        local of = if along then alleys(column + ahead, row, false) else alleys(column, row + ahead, true)
        for _, alley in of do
          if math.abs(alley - aside) < NEAR then
            return true
          end
        end
        return false
      end
      -- An alley ends with its block; otherwise a street follows the line between two blocks, or belongs to another
      -- pattern.
      return not has_alley(0) and (has_alley(-1) or has_alley(1) or is_one(column, row, along))
    end,
  })
end

-- Streets from a `middle` (m), and rings around it at distances of about `block` (m). `gap` is the fraction of
-- omitted side streets, and `variety` from 0 to 1 is the variation of blocks: rings have different distances,
-- quarters have small or large blocks, and there are parks.
function patterns.radial(options: { [string]: any }?): Pattern
  local of: { [string]: any } = options or {}
  checks.options("roads.radial", of, KNOWN)
  local block = number("roads.radial: block", of.block, 90, 20, 500)
  local variety = number("roads.radial: variety", of.variety, 1, 0, 1)
  local gap = number("roads.radial: gap", of.gap, 0.36, 0, 0.6)
  local middle = checks.place("roads.radial: middle", of.middle or { 0, 0 })
  local field = math.floor(random() * 1000000)
  local rings = {}
  for _, radius in lines(block, variety, field) do
    if radius > 0 then
      table.insert(rings, radius)
    end
  end
  -- The relative width of blocks at a position.
  local function wide(x: number, y: number): number
    local much = 0.15 * variety + noise(x / (block * 4), y / (block * 4), 7.5, field)
    return math.clamp(math.exp(3.5 * variety * much), 0.4, 2)
  end
  -- The rings next to a distance (m) from the centre, on the inner and on the outer side, with the lanes halfway
  -- between them in quarters of small blocks.
  local function around(far: number, x: number, y: number, depth: number): (number, number)
    local inner = below(rings, far)
    local low, high = rings[inner] or 0, rings[inner + 1] or far + block
    local half = (low + high) / 2
    if depth > 0 and inner > 0 and high - low > 60 and wide(x, y) < 0.7 then
      if far < half then
        high = half
      else
        low = half
      end
    end
    return low, high
  end
  local usual = { branching = 0.95, both = 0.9, cross = 0.5, stop = 0, gap = 0, every = 3 }
  return pattern.make("roads.radial", of, usual, {
    straight = true,
    toward = function(x: number, y: number, heading: number, length: number, depth: number): number
      local dx, dy = x - middle[1], y - middle[2]
      local far = math.sqrt(dx * dx + dy * dy)
      if far < rings[1] / 2 then
        return heading
      end
      local ray = math.deg(math.atan2(dy, dx))
      -- A street along a ring ends on the ring, wherever it begins.
      local low, high = around(far, x, y, depth)
      local ring = if low > 0 and far - low < high - far then low else high
      local bent = (far * far + length * length - ring * ring) / (2 * far * length)
      local inward = math.deg(math.acos(math.clamp(bent, -0.5, 0.9)))
      return nearest(heading, { ray, ray + 180, ray + 180 - inward, ray + 180 + inward })
    end,
    length = function(x: number, y: number, heading: number, depth: number): number
      local dx, dy = x - middle[1], y - middle[2]
      local ray = math.deg(math.atan2(dy, dx))
      local across = math.abs(between(ray, heading)) % 180
      if across < 45 or across > 135 then
        -- To the next ring, or to the ring behind it if the next ring is near.
        local far = math.sqrt(dx * dx + dy * dy)
        local near = 0.15 * block
        local low, high = around(if across < 45 then far + near else far - near, x, y, depth)
        local to = if across < 45 then high elseif low > 0 then low else far - block
        return math.max(0.3 * block, math.abs(to - far))
      end
      local much = math.clamp(wide(x, y), if depth == 0 then 0.9 else 0.4, 1.2)
      return math.max(0.4, much * (1 + variety * random(-0.25, 0.35))) * block
    end,
    gap = 0,
    closed = function(x: number, y: number): boolean
      local open = wide(x, y)
      local out = if open > 1 then 1 - (1 - gap) / open else gap * math.max(open, 0.7)
      return drawn(math.floor(x / 8 + 0.5), math.floor(y / 8 + 0.5), field) < out
        or variety * noise(x / (block * 3), y / (block * 3), 3.5, field) > 0.3
    end,
  })
end

-- Streets along contour lines, and straight streets up and down slopes up to `steepest` (degrees); on steeper slopes
-- they climb obliquely. `height` returns the height (m) at a position, like a terrain: function(x, y) return
-- land:height({ x, y }) end.
function patterns.contours(height: (x: number, y: number) -> number, options: { [string]: any }?): Pattern
  local of: { [string]: any } = options or {}
  checks.options("roads.contours", of, KNOWN)
  checks.field("roads.contours: height", height)
  local block = number("roads.contours: block", of.block, 80, 20, 500)
  local steepest = number("roads.contours: steepest", of.steepest, 9, 1, 45)
  local most = math.tan(math.rad(steepest))
  local usual = { branching = 0.55, both = 0.15, cross = 0.2, stop = 0.15, gap = 0, every = 5 }
  return pattern.make("roads.contours", of, usual, {
    toward = function(x: number, y: number, heading: number, length: number): number
      local near = length / 4
      local east = (height(x + near, y) - height(x - near, y)) / (2 * near)
      local north = (height(x, y + near) - height(x, y - near)) / (2 * near)
      local slope = math.sqrt(east * east + north * north)
      if slope < 0.005 then
        return heading
      end
      local up = math.deg(math.atan2(north, east))
      -- The angle from the direction of steepest ascent that limits the slope of a street.
      local slant = if slope > most then math.deg(math.acos(most / slope)) else 0
      local along = nearest(heading, { up + 90, up - 90 })
      -- The contour bends: its direction at the end of the street has half the weight.
      local tx, ty = math.cos(math.rad(along)) * length, math.sin(math.rad(along)) * length
      local lost = height(x + tx, y + ty) - height(x, y)
      local bend = math.deg(math.atan2(lost / slope, length))
      along += if between(up, along) > 0 then bend else -bend
      local ways = { along, up + slant, up - slant, up + 180 + slant, up + 180 - slant }
      return nearest(heading, ways)
    end,
    length = function(_: number, _: number, _: number, depth: number): number
      return block * (if depth == 0 then 1 else random(0.8, 1.2))
    end,
  })
end

-- Streets that turn towards a higher population. `people` returns the population at a position (m), from 0 to 1.
function patterns.populous(people: (x: number, y: number) -> number, options: { [string]: any }?): Pattern
  local of: { [string]: any } = options or {}
  checks.options("roads.populous", of, KNOWN)
  checks.field("roads.populous: people", people)
  local block = number("roads.populous: block", of.block, 80, 20, 500)
  local bends = number("roads.populous: bends", of.bends, 20, 0, 60)
  local usual = { branching = 0.75, both = 0.25, cross = 0.25, skew = 6, stop = 0.1, gap = 0, every = 5 }
  return pattern.make("roads.populous", of, usual, {
    toward = function(x: number, y: number, heading: number, length: number, depth: number): number
      local best, most = heading, -1
      for try = -2, 2 do
        local turned = heading + try * bends / 2
        local way = math.rad(turned)
        local found = 0
        -- Distant population has less weight.
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
    length = function(x: number, y: number): number
      return block * (1.5 - 0.8 * math.clamp(people(x, y), 0, 1)) * random(0.85, 1.15)
    end,
  })
end

-- The pattern at each position, from the nearest of some districts: { at = { x, y }, pattern = ... }.
function patterns.districts(
  districts: { { at: { number }, pattern: Pattern } }
): (x: number, y: number) -> Pattern
  if #districts == 0 then
    error("roads.districts takes one district or more: { at = { x, y }, pattern = ... }", 2)
  end
  for index, district in districts do
    checks.place(`roads.districts: at of district {index}`, district.at)
    pattern.check(`roads.districts: the pattern of district {index}`, district.pattern, 3)
  end
  return function(x: number, y: number)
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

return patterns
