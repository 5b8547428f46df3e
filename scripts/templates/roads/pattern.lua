--!strict
-- Patterns: their fields, their construction from options, and their checks.
local checks = require("checks")

local pattern = {}

local number = checks.number

export type Pattern = {
  -- The heading (degrees from east, counter-clockwise) of a street that leaves a place (m) about towards `heading`.
  toward: (x: number, y: number, heading: number, length: number, depth: number) -> number,
  -- The length (m) of a street that leaves a place, to the next junction.
  length: (x: number, y: number, heading: number, depth: number) -> number,
  -- The chance that a side street leaves a junction, and that there is one on the other side as well.
  side: number,
  both: number,
  -- The chance that a street that meets another goes on behind it.
  cross: number,
  -- The greatest turn (degrees) of side streets from square.
  skew: number,
  -- The chance that a small side street ends at a junction.
  stop: number,
  -- The share of places that side streets leave out, the same from both ends.
  gap: number,
  -- Tells if a side street that leaves a place is left out, in place of `gap`; both of its ends have to find the same.
  closed: ((x: number, y: number, heading: number, length: number, depth: number) -> boolean)?,
  -- The share of side streets that leave around a small green, of every third junction; none does if it is left out.
  greens: number?,
  -- The snap distance (m) of a street's end, and the distance (m) over which dead ends are joined, if the script says neither.
  snap: number?,
  join: number?,
  -- The least length (m) of a side street that leaves another.
  least: number?,
  -- The distance (m) beyond its end at which a side street sees another, and leads on to it.
  sight: number?,
  -- Every so many junctions a main street divides; 0 for never.
  every: number,
  -- True if main streets turn aside for obstacles alone.
  straight: boolean?,
  -- The largest block (m²) of a place, by its distance from the centre as a share of the extent and by the kind of its quarter from
  -- -1 to 1. Only main streets grow then, and the land between them is divided.
  room: ((x: number, y: number, far: number, kind: number) -> number)?,
  -- The swing of streets that divide land, as a share of their length, and the share of crescents among them.
  bow: number?,
  crescents: number?,
}

-- The fields that every pattern has.
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

-- The options of all patterns that are here.
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

-- A pattern: what says where streets go, and chances from `options`, or else the usual ones.
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

-- A number from 0 to 1 that looks drawn, and is the same for the same whole numbers.
function pattern.drawn(a: number, b: number, seed: number): number
  local mixed = bit32.bxor(a * 73856093 % 2 ^ 32, b * 19349663 % 2 ^ 32, seed * 83492791 % 2 ^ 32)
  mixed = bit32.bxor(mixed, bit32.rshift(mixed, 15)) % 2 ^ 32
  mixed = (mixed * 668265261) % 2 ^ 32
  return bit32.bxor(mixed, bit32.rshift(mixed, 13)) % 65536 / 65536
end

-- Refuses what is no pattern, so many levels up.
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
