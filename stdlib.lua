--!strict
-- Burgeon's standard library: what every script has besides Luau itself. It returns the names it gives.

-- Vectors.
-- Immutable, three numbers x, y and z in metres; they may travel in modules.

local Vec = {}
Vec.__index = Vec

--- A vector.
local function vec(x: number?, y: number?, z: number?)
  return setmetatable({ x = x or 0, y = y or 0, z = z or 0 }, Vec)
end

function Vec.__add(a, b)
  return vec(a.x + b.x, a.y + b.y, a.z + b.z)
end

function Vec.__sub(a, b)
  return vec(a.x - b.x, a.y - b.y, a.z - b.z)
end

function Vec.__unm(a)
  return vec(-a.x, -a.y, -a.z)
end

function Vec.__mul(a, b)
  if type(a) == "number" then
    return vec(a * b.x, a * b.y, a * b.z)
  elseif type(b) == "number" then
    return vec(a.x * b, a.y * b, a.z * b)
  end
  return vec(a.x * b.x, a.y * b.y, a.z * b.z)
end

function Vec.__div(a, b)
  return vec(a.x / b, a.y / b, a.z / b)
end

function Vec.__eq(a, b)
  return a.x == b.x and a.y == b.y and a.z == b.z
end

function Vec.__tostring(a)
  return `vec({a.x}, {a.y}, {a.z})`
end

function Vec.dot(a, b)
  return a.x * b.x + a.y * b.y + a.z * b.z
end

function Vec.cross(a, b)
  return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
end

function Vec.length(a)
  return math.sqrt(a.x * a.x + a.y * a.y + a.z * a.z)
end

--- The vector with length 1; a zero vector stays.
function Vec.unit(a)
  local length = Vec.length(a)
  return if length > 0 then a / length else a
end

function Vec.distance(a, b)
  return Vec.length(a - b)
end

function Vec.lerp(a, b, t: number)
  return a + (b - a) * t
end

__class("vec", Vec)

-- Numbers.

--- From `a` to `b` as `t` goes from 0 to 1.
local function lerp(a: number, b: number, t: number): number
  return a + (b - a) * t
end

--- Maps `x` from one range to another.
local function remap(x: number, from: number, to: number, low: number, high: number): number
  return low + (high - low) * (x - from) / (to - from)
end

--- Easing: each maps 0..1 to 0..1.
local ease = {
  ["in"] = function(t: number): number
    return t * t
  end,
  out = function(t: number): number
    return 1 - (1 - t) * (1 - t)
  end,
  inout = function(t: number): number
    return if t < 0.5 then 2 * t * t else 1 - 2 * (1 - t) * (1 - t)
  end,
  smooth = function(t: number): number
    return t * t * (3 - 2 * t)
  end,
  sine = function(t: number): number
    return (1 - math.cos(math.pi * t)) / 2
  end,
  back = function(t: number): number
    return t * t * (2.70158 * t - 1.70158)
  end,
}

-- Noise.

-- A number from 0 to 1 for each point of a lattice: three rounds of a 32-bit integer hash.
local function hash(x: number, y: number, z: number, seed: number): number
  local h =
    bit32.bxor(x % 4294967296, bit32.lrotate(y % 4294967296, 11), bit32.lrotate(z % 4294967296, 22), seed)
  for _ = 1, 3 do
    h = bit32.bxor(h, bit32.rshift(h, 16))
    -- The product of two 32-bit numbers does not fit a number exactly, so it is made of two halves.
    local low, high = bit32.band(h, 0xFFFF), bit32.rshift(h, 16)
    h = (low * 0x45D9F3B + (high * 0x45D9F3B % 65536) * 65536) % 4294967296
  end
  return h / 4294967296
end

--- Value noise, smooth, from -1 to 1, with features of size 1; `seed` gives another field.
local function noise(x: number, y: number?, z: number?, seed: number?): number
  local py, pz, s = y or 0, z or 0, seed or 0
  local ix, iy, iz = math.floor(x), math.floor(py), math.floor(pz)
  local fx, fy, fz = ease.smooth(x - ix), ease.smooth(py - iy), ease.smooth(pz - iz)
  local function row(dy: number, dz: number): number
    return lerp(hash(ix, iy + dy, iz + dz, s), hash(ix + 1, iy + dy, iz + dz, s), fx)
  end
  local low = lerp(row(0, 0), row(1, 0), fy)
  local high = lerp(row(0, 1), row(1, 1), fy)
  return 2 * lerp(low, high, fz) - 1
end

-- Colours.
-- As objects take them: { red, green, blue } from 0 to 1, sRGB.

--- A colour from hue (degrees), saturation and value (0 to 1).
local function hsv(hue: number, saturation: number, value: number): { number }
  local function channel(n: number): number
    local k = (n + hue / 60) % 6
    return value - value * saturation * math.clamp(math.min(k, 4 - k), 0, 1)
  end
  return { channel(5), channel(3), channel(1) }
end

--- A colour from "#rrggbb".
local function rgb(hex: string): { number }
  local digits = string.match(hex, "^#(%x%x%x%x%x%x)$")
  if not digits then
    error(`rgb takes a colour such as "#336699", not "{hex}"`, 2)
  end
  local number = tonumber(digits, 16) :: number
  return { (number // 65536) / 255, (number // 256 % 256) / 255, (number % 256) / 255 }
end

--- Mixes two colours, each "#rrggbb" or a list.
local function mix(a: any, b: any, t: number): { number }
  local from = if type(a) == "string" then rgb(a) else a
  local to = if type(b) == "string" then rgb(b) else b
  return { lerp(from[1], to[1], t), lerp(from[2], to[2], t), lerp(from[3], to[3], t) }
end

-- The turtle's modules --------------------------------------------------------------------------------------
-- The symbols of The Algorithmic Beauty of Plants, for every system whose object is a turtle. Lengths in
-- metres, angles in degrees; what is left out is the turtle's own step, angle or width.

local names: { [string]: any } = {}

--- Declares a module that calls a method of the turtle with its parameter.
local function turtle_module(name: string, method: string, parameter: string?)
  names[name] = if parameter then module(name, parameter) else module(name)
  __interpretation("turtle", name, method)
end

-- F draws and G, the literature's f, only moves.
turtle_module("F", "forward", "length?")
turtle_module("G", "advance", "length?")
-- + and -: to the left and to the right; Turn is + with a sign.
turtle_module("Turn", "turn", "angle?")
turtle_module("Left", "turn", "angle?")
turtle_module("Right", "turn_right", "angle?")
-- & and ^: down and up; Pitch is & with a sign.
turtle_module("Pitch", "pitch", "angle?")
turtle_module("Down", "pitch", "angle?")
turtle_module("Up", "pitch_up", "angle?")
-- \ and /; Roll is \ with a sign.
turtle_module("Roll", "roll", "angle?")
turtle_module("RollLeft", "roll", "angle?")
turtle_module("RollRight", "roll_back", "angle?")
-- |
turtle_module("TurnAround", "turn_around")
-- $
turtle_module("Level", "level")
-- ! and ;
turtle_module("Width", "width", "width")
turtle_module("Paint", "paint", "number")
turtle_module("Color", "color", "color")
turtle_module("Material", "material", "material")
-- { . }
turtle_module("BeginPolygon", "begin_polygon")
turtle_module("Point", "point")
turtle_module("EndPolygon", "end_polygon")
-- @O
turtle_module("Sphere", "sphere", "radius")
-- Bends towards the tropism with each step.
turtle_module("Elasticity", "elasticity", "elasticity")
-- ~
names.Place = module("Place", "model", "scale?")
__interpretation("turtle", "Place", "place")

names.vec = vec
names.lerp = lerp
names.remap = remap
names.ease = ease
names.noise = noise
names.hsv = hsv
names.rgb = rgb
names.mix = mix
table.freeze(Vec)
return names
