--!strict
-- Patterns: their fields, their construction from options, and their checks.
local checks = require("checks")

local pattern = {}

local number = checks.number

export type Pattern = {
  -- The heading (degrees from east, counter-clockwise) of a street that leaves a position (m) approximately towards
  -- `heading`.
  toward: (x: number, y: number, heading: number, length: number, depth: number) -> number,
  -- The length (m) of a street that leaves a position, to the next junction.
  length: (x: number, y: number, heading: number, depth: number) -> number,
  -- The probability that a side street leaves a junction, and the probability of another one on the other side.
  side: number,
  both: number,
  -- The probability that a street continues behind a street that it meets.
  cross: number,
  -- The maximum deviation (degrees) of side streets from a right angle.
  skew: number,
  -- The probability that a small side street ends at a junction.
  stop: number,
  -- The fraction of positions without side streets, the same from both ends.
  gap: number,
  -- Returns true if a side street that leaves a position is omitted, instead of `gap`; both of its ends must return
  -- the same.
  closed: ((x: number, y: number, heading: number, length: number, depth: number) -> boolean)?,
  -- The fraction of side streets that leave around a small green, at every third junction; none if omitted.
  greens: number?,
  -- The snap distance (m) of a street's end, and the distance (m) over which dead ends are joined, if the script sets
  -- neither.
  snap: number?,
  join: number?,
  -- The minimum length (m) of a side street that leaves another street.
  least: number?,
  -- The distance (m) beyond its end at which a side street finds another street, and is extended to it.
  sight: number?,
  -- The number of junctions between two divisions of a main street; 0 for no divisions.
  every: number,
  -- True if main streets turn only for obstacles.
  straight: boolean?,
  -- The maximum block (m²) at a position, by its distance from the centre as a fraction of the extent, and by the
  -- kind of its quarter from -1 to 1. If given, only main streets grow, and the land between them is divided.
  room: ((x: number, y: number, far: number, kind: number) -> number)?,
  -- The swing of streets that divide land, as a fraction of their length, and the fraction of crescents.
  bow: number?,
  crescents: number?,
}

-- The fields of every pattern.
local KINDS: { [string]: string } = {
  toward = "function",
  length = "function",
  side = "number",
  both = "number",
  cross = "number",
  skew = "number",
  stop = "number",
  gap = "number",
  every = "number",
}

-- The options of all patterns in this library.
pattern.KNOWN = {
  block = "number",
  width = "number",
  angle = "number",
  bends = "number",
  branching = "number",
  cross = "number",
  skew = "number",
  stop = "number",
  gap = "number",
  greens = "number",
  every = "number",
  middle = "table",
  steepest = "number",
  variety = "number",
}

-- Creates a pattern from its functions and from the probabilities in `options`, with defaults.
function pattern.make(
  name: string,
  options: { [string]: any },
  usual: { [string]: number },
  ways: { [string]: any },
  ...: any
): any
  local made: any = { skew = 0, both = usual.both }
  for _, chance in
    {
      { "branching", 1 },
      { "cross", 1 },
      { "skew", 40 },
      { "stop", 1 },
      { "gap", 0.6 },
      { "greens", 1 },
      { "every", 100 },
    } :: any
  do
    local key, most = chance[1], chance[2]
    if usual[key] then
      made[key] = number(`{name}: {key}`, options[key], usual[key], 0, most, 4)
    end
  end
  made.side = made.branching
  for key, way in ways do
    made[key] = way
  end
  return made
end

-- A pseudo-random number from 0 to 1 that depends only on the given integers.
function pattern.drawn(a: number, b: number, seed: number): number
  local mixed = bit32.bxor(a * 73856093 % 2 ^ 32, b * 19349663 % 2 ^ 32, seed * 83492791 % 2 ^ 32)
  mixed = bit32.bxor(mixed, bit32.rshift(mixed, 15)) % 2 ^ 32
  mixed = (mixed * 668265261) % 2 ^ 32
  return bit32.bxor(mixed, bit32.rshift(mixed, 13)) % 65536 / 65536
end

-- Refuses a value that is not a pattern, the given number of levels up.
function pattern.check(name: string, value: any, level: number): Pattern
  if type(value) ~= "table" then
    error(`{name} must be a pattern, such as roads.organic(), not {type(value)}`, level)
  end
  for key, kind in KINDS do
    if type(value[key]) ~= kind then
      error(`{name} has no {kind} called {key}; a pattern has what roads.organic() has`, level)
    end
  end
  return value
end

return pattern
