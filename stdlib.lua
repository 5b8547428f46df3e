--!strict
-- Burgeon's standard library: the names of every script besides Luau's own. It returns a table of these names.

local describe_plain: (value: any) -> string, refuse_plain: (message: string) -> never = __describe, __refuse
-- table.freeze for tables whose metatable has no lock, in half the time.
local freeze: (value: any) -> any = __freeze
-- The letters in patterns and strings that are no modules: their names with parameters.
local undeclared_letters: (patterns: { string }, strings: { string }) -> { { string } } = __letters
-- The channels of a colour as text, from 0 to 1: red, green, blue and opacity. Otherwise the nearest name, or nothing.
local read_color: (text: string) -> ({ number }?, string?) = __color

-- Raises an error at the line of the script that caused it. The cause can be in the data.
local function refuse(message: string, remedy: string?)
  refuse_plain(`{message}\1{remedy or ""}\2`)
end

local Vec = {}
local AXES = { "x", "y", "z" }

local function is_vector(value)
  return getmetatable(value) == Vec
end

local function describe(value: any): string
  return if is_vector(value) then "a vector" else describe_plain(value)
end

--- Refuses an argument that is not a number.
local function check_numbers(name: string, ...: any)
  for index = 1, select("#", ...) do
    local value = (select(index, ...))
    if type(value) ~= "number" then
      refuse(`{name} takes numbers, but argument {index} is {describe(value)}`)
    end
  end
end

-- Vectors.
-- Immutable, with three numbers x, y and z in metres. Modules can carry them.

-- A vector can be read like a list: 1, 2 and 3 are x, y and z.
function Vec.__index(vector, key)
  local axis = AXES[key]
  if axis then
    return rawget(vector, axis)
  end
  local method = Vec[key]
  -- As in a list, there is no value after the last number.
  if method == nil and type(key) ~= "number" then
    local named = if type(key) == "string" then key else describe(key)
    refuse(`a vector has no {named}`, "it has x, y and z, or 1 to 3, and methods such as length")
  end
  return method
end

function Vec.__len()
  return 3
end

local function is_list(value)
  return type(value) == "table" and type(value[1]) == "number" and type(value[2]) == "number"
end

--- Vectors are values, so nothing can change one that others have.
local function made(x, y, z)
  return freeze(setmetatable({ x = x, y = y, z = z }, Vec))
end

local function finite(x: number, y: number, z: number)
  -- The difference of a number that is not finite from itself is not 0.
  if x - x + (y - y) + (z - z) ~= 0 then
    local axis, value = "z", z
    if x - x ~= 0 then
      axis, value = "x", x
    elseif y - y ~= 0 then
      axis, value = "y", y
    end
    refuse(`{axis} of vec is {describe(value)}`, "a vector has finite numbers")
  end
  return made(x, y, z)
end

-- Handles arguments other than three numbers: a list, or fewer numbers.
local function from_others(...: any)
  local count = select("#", ...)
  local first = (...)
  if count == 1 and type(first) == "table" then
    local x, y, z = first[1], first[2], first[3]
    if type(x) ~= "number" or type(y) ~= "number" or (z ~= nil and type(z) ~= "number") then
      refuse(
        "vec takes a list of two or three numbers, but this table is none",
        "write vec({ 1, 2, 3 }) or vec(1, 2, 3)"
      )
    end
    return finite(x, y, z or 0)
  elseif count > 3 then
    refuse(`vec takes three numbers, not {count}`, "write vec(x, y, z)")
  end
  local last = count
  while last > 1 and (select(last, ...)) == nil do
    last -= 1
  end
  for index = 1, last do
    local value = (select(index, ...))
    if type(value) ~= "number" then
      refuse(
        `{AXES[index]} of vec is {describe(value)}`,
        "write vec(x, y, z); what is left out at the end is 0"
      )
    end
  end
  local x, y, z = ...
  return finite(x or 0, y or 0, z or 0)
end

-- For readers of this file; Rust declares the vector with its methods.
type Vector = any

--- Creates a vector from three numbers, or from a list of them; omitted numbers at the end are 0.
local function vec(...: any): Vector
  local x, y, z, more = ...
  if
    type(x) == "number"
    and type(y) == "number"
    and type(z) == "number"
    and more == nil
    and x - x + (y - y) + (z - z) == 0
  then
    return freeze(setmetatable({ x = x, y = y, z = z }, Vec))
  end
  return from_others(...)
end

--- Creates a vector from a `radius` (m), an `angle` (degrees) from the x axis towards the y axis, and a height `z` (m, 0 unless
--- given).
local function polar(radius: number, angle: number, z: number?): Vector
  local height = z or 0
  check_numbers("polar", radius, angle, height)
  if radius - radius + (angle - angle) + (height - height) ~= 0 then
    refuse("polar takes finite numbers", "write polar(radius, angle, z), with the angle in degrees")
  end
  local turn = math.rad(angle)
  return made(radius * math.cos(turn), radius * math.sin(turn), height)
end

--- Returns both operands of an operator as vectors; a list becomes a vector.
local function vectors(a, b, operator: string)
  local function one(value)
    if is_vector(value) then
      return value
    elseif not is_list(value) then
      local remedy = if operator == "+" or operator == "-"
        then "write vec(x, y, z); * and / also take numbers"
        else nil
      refuse(`{operator} takes two vectors, but one side is {describe(value)}`, remedy)
    end
    return vec(value)
  end
  return one(a), one(b)
end

function Vec.__add(a, b)
  if not is_vector(a) or not is_vector(b) then
    a, b = vectors(a, b, "+")
  end
  return made(a.x + b.x, a.y + b.y, a.z + b.z)
end

function Vec.__sub(a, b)
  if not is_vector(a) or not is_vector(b) then
    a, b = vectors(a, b, "-")
  end
  return made(a.x - b.x, a.y - b.y, a.z - b.z)
end

function Vec.__unm(a)
  return made(-a.x, -a.y, -a.z)
end

function Vec.__mul(a, b)
  if type(a) == "number" then
    return made(a * b.x, a * b.y, a * b.z)
  elseif type(b) == "number" then
    return made(a.x * b, a.y * b, a.z * b)
  elseif not is_vector(a) or not is_vector(b) then
    a, b = vectors(a, b, "*")
  end
  return made(a.x * b.x, a.y * b.y, a.z * b.z)
end

function Vec.__div(a, b)
  if type(b) ~= "number" or not is_vector(a) then
    refuse(`a vector is divided by a number: {describe(a)} cannot be divided by {describe(b)}`)
  end
  return made(a.x / b, a.y / b, a.z / b)
end

function Vec.__eq(a, b)
  return a.x == b.x and a.y == b.y and a.z == b.z
end

function Vec.__tostring(a)
  return `vec({a.x}, {a.y}, {a.z})`
end

--- Refuses an argument of a vector method that is not a vector.
local function check_vectors(name: string, a, b)
  if not is_vector(a) then
    refuse(`{name} is called with a colon, on a vector: v:{name}(...), not on {describe(a)}`)
  elseif not is_vector(b) and not is_list(b) then
    refuse(`{name} takes a vector, not {describe(b)}`)
  end
  return a, if is_vector(b) then b else vec(b)
end

function Vec.dot(a, b)
  a, b = check_vectors("dot", a, b)
  return a.x * b.x + a.y * b.y + a.z * b.z
end

function Vec.cross(a, b)
  a, b = check_vectors("cross", a, b)
  return made(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
end

function Vec.length(a)
  check_vectors("length", a, a)
  return math.sqrt(a.x * a.x + a.y * a.y + a.z * a.z)
end

--- Returns the vector with length 1; a zero vector stays unchanged.
function Vec.unit(a)
  check_vectors("unit", a, a)
  local length = Vec.length(a)
  return if length > 0 then a / length else a
end

function Vec.distance(a, b)
  a, b = check_vectors("distance", a, b)
  return Vec.length(a - b)
end

function Vec.lerp(a, b, t: number)
  a, b = check_vectors("lerp", a, b)
  if type(t) ~= "number" then
    refuse(`lerp takes a vector and a number, not {describe(t)}`)
  end
  return a + (b - a) * t
end

__class("vec", Vec, made, "x", "y", "z")

-- Numbers.

--- Interpolates linearly from `a` (`t` = 0) to `b` (`t` = 1): numbers or vectors.
--- (a: Vector, b: Vector, t: number) -> Vector
local function lerp(a: number, b: number, t: number): number
  if type(a) ~= "number" or type(b) ~= "number" or type(t) ~= "number" then
    if is_vector(a) then
      return Vec.lerp(a, b, t)
    end
    check_numbers("lerp", a, b, t)
  end
  return a + (b - a) * t
end

--- Maps `x` linearly from one range to another.
local function remap(x: number, from: number, to: number, low: number, high: number): number
  check_numbers("remap", x, from, to, low, high)
  return low + (high - low) * (x - from) / (to - from)
end

local function smooth(t: number): number
  return t * t * (3 - 2 * t)
end

--- A function from 0 to 1 that refuses arguments that are not numbers.
local function curve(name: string, curved: (t: number) -> number)
  return function(t: number): number
    if type(t) ~= "number" then
      check_numbers(`ease.{name}`, t)
    end
    return curved(t)
  end
end

--- Easing functions, each from 0 at 0 to 1 at 1.
local ease = {
  ["in"] = curve("in", function(t)
    return t * t
  end),
  out = curve("out", function(t)
    return 1 - (1 - t) * (1 - t)
  end),
  inout = curve("inout", function(t)
    return if t < 0.5 then 2 * t * t else 1 - 2 * (1 - t) * (1 - t)
  end),
  smooth = curve("smooth", smooth),
  sine = curve("sine", function(t)
    return (1 - math.cos(math.pi * t)) / 2
  end),
  back = curve("back", function(t)
    return t * t * (2.70158 * t - 1.70158)
  end),
}

-- Noise.

-- A number from 0 to 1 for each point of a lattice: three rounds of a 32-bit integer hash.
local function hash(x: number, y: number, z: number, seed: number): number
  local h =
    bit32.bxor(x % 4294967296, bit32.lrotate(y % 4294967296, 11), bit32.lrotate(z % 4294967296, 22), seed)
  for _ = 1, 3 do
    h = bit32.bxor(h, bit32.rshift(h, 16))
    -- The product of two 32-bit numbers exceeds the exact range, so it is computed from two halves.
    local low, high = bit32.band(h, 0xFFFF), bit32.rshift(h, 16)
    h = (low * 0x45D9F3B + (high * 0x45D9F3B % 65536) * 65536) % 4294967296
  end
  return h / 4294967296
end

--- Smooth value noise from -1 to 1, with features of size 1, at `x`, `y` (0 unless given) and `z` (0 unless given). Each
--- `seed` (0 unless given) gives another field.
local function noise(x: number, y: number?, z: number?, seed: number?): number
  local py, pz, s = y or 0, z or 0, seed or 0
  if type(x) ~= "number" or type(py) ~= "number" or type(pz) ~= "number" or type(s) ~= "number" then
    check_numbers("noise", x, py, pz, s)
  end
  local ix, iy, iz = math.floor(x), math.floor(py), math.floor(pz)
  local fx, fy, fz = smooth(x - ix), smooth(py - iy), smooth(pz - iz)
  local function row(dy: number, dz: number): number
    return lerp(hash(ix, iy + dy, iz + dz, s), hash(ix + 1, iy + dy, iz + dz, s), fx)
  end
  local low = lerp(row(0, 0), row(1, 0), fy)
  local high = lerp(row(0, 1), row(1, 1), fy)
  return 2 * lerp(low, high, fz) - 1
end

-- Colours.
-- As objects take them: { red, green, blue } from 0 to 1, sRGB.

--- Creates a colour from `hue` (degrees), `saturation` and `value` (0 to 1).
local function hsv(hue: number, saturation: number, value: number): { number }
  check_numbers("hsv", hue, saturation, value)
  local function channel(n: number): number
    local k = (n + hue / 60) % 6
    return value - value * saturation * math.clamp(math.min(k, 4 - k), 0, 1)
  end
  return { channel(5), channel(3), channel(1) }
end

--- Returns the channels of a colour as text for the function `name`.
local function channels_of(name: string, text: any): { number }
  local digits = if type(text) == "string" then string.match(text, "^#(%x%x%x%x%x%x)$") else nil
  if digits then
    local number = tonumber(digits, 16) :: number
    return { (number // 65536) / 255, (number // 256 % 256) / 255, (number % 256) / 255 }
  end
  local found: { number }?, near: string? = nil, nil
  if type(text) == "string" then
    found, near = read_color(text)
  end
  if not found then
    local remedy = if near then `write "{near}"` else ""
    refuse(`{name} takes a colour such as "#336699" or "orange", not {describe(text)}`, remedy)
  end
  local known = found :: { number }
  if known[4] ~= 1 then
    refuse(`{name} takes a colour without opacity, not {describe(text)}`, "leave out the last digits")
  end
  return { known[1], known[2], known[3] }
end

--- Creates a colour from "#rrggbb" or a name such as "orange".
local function rgb(text: string): { number }
  return channels_of("rgb", text)
end

--- Mixes two colours, each "#rrggbb", a name such as "orange", or a list. Below 0 and above 1, `t` gives the nearer colour.
local function mix(a: any, b: any, t: number): { number }
  local function color(value: any): { number }
    if type(value) == "table" then
      check_numbers("mix of colours", value[1], value[2], value[3])
      return value
    end
    return channels_of("mix", value)
  end
  local from, to = color(a), color(b)
  check_numbers("mix", 0, 0, t)
  if t ~= t then
    refuse("mix takes an amount from 0 to 1, not nan")
  end
  local amount = math.clamp(t, 0, 1)
  return { lerp(from[1], to[1], amount), lerp(from[2], to[2], amount), lerp(from[3], to[3], amount) }
end

-- Models.

--- Builds a model from what `object` draws in `begin` and `finish` of its type, without a system.
local function prototype(object: any): Derived
  local system = lsystem({ object = object })
  system:axiom()
  return system:derive(0)
end

-- L-systems as books print them.

local ABOP_OPTIONS = { "axiom", "angle", "step", "width", "ignore", "consider", "object" }
local OF_TURTLE = { "angle", "step", "width" }
local ABOP_USAGE = `write abop(\{ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", angle = 25.7 })`

-- Adds the successors of a value of `abop`, each as { weight, text }; the weight of a single successor is nil.
local function add_successors(pattern: string, value: any, add: (weight: number?, text: string) -> ())
  if type(value) == "string" then
    return add(nil, value)
  elseif type(value) ~= "table" or #value == 0 then
    refuse(
      `the successor of {pattern} in abop is {describe(value)}`,
      `write a string, a list of strings, or a list of weights and strings: \{ \{ 2, "F" }, \{ 1, "FF" } }`
    )
  end
  for index, item in value :: { any } do
    local weight, text: any = 1, item
    if type(item) == "table" then
      weight, text = item[1], item[2]
    end
    if type(weight) ~= "number" or not (weight >= 0 and weight < math.huge) or type(text) ~= "string" then
      refuse(
        `successor {index} of {pattern} in abop is neither a string nor a weight with a string`,
        `write \{ "F[+F]F", "F[-F]F" } or \{ \{ 2, "F" }, \{ 1, "FF" } }`
      )
    end
    add(weight, text)
  end
end

--- Creates a system as books print it: `axiom` and rules are strings, and each other key is the pattern of a rule. The
--- options are `angle` (degrees), `step` (m) and `width` (m) of the turtle, or another `object`, and `ignore` and
--- `consider`. A list of strings is a random choice, and can have weights: { { 2, "F" }, { 1, "FF" } }.
local function abop(plant: { [string]: any }): System<any>
  if type(plant) ~= "table" then
    refuse(`abop takes a table, not {describe(plant)}`, ABOP_USAGE)
  elseif type(plant.axiom) ~= "string" then
    refuse(`axiom of abop is {describe(plant.axiom)}, not a string`, ABOP_USAGE)
  end
  local patterns: { string }, texts: { string } = {}, { plant.axiom }
  for key in plant :: { [any]: any } do
    if type(key) ~= "string" then
      refuse(`a key of abop is {describe(key)}, not the pattern of a rule`, ABOP_USAGE)
    elseif not table.find(ABOP_OPTIONS, key) then
      -- A word without contexts is the name of a module, unless all its letters are modules.
      local word = string.match(string.gsub(key, "%b()", ""), "^%s*([%a_][%w_]+)%s*$")
      if word and #undeclared_letters({ word }, {}) > 0 then
        local is_option = word == key and string.find(key, "^[%l_]+$")
        refuse(
          if is_option then `abop has no option {key}` else `{word} in abop is neither a letter nor a module`,
          if is_option
            then `it has {table.concat(ABOP_OPTIONS, ", ")}; other keys are patterns of rules`
            else `declare it before: local {word} = module("{word}")`
        )
      end
      table.insert(patterns, key)
    end
  end
  -- Keys have no order of their own, so rules with longer contexts come first, as in the literature.
  local function context(pattern: string): number
    return #string.gsub(string.gsub(pattern, "%b()", ""), "%s", "")
  end
  table.sort(patterns, function(a: string, b: string)
    local long, short = context(a), context(b)
    return if long == short then a < b else long > short
  end)
  for _, pattern in patterns do
    add_successors(pattern, plant[pattern], function(_, text)
      table.insert(texts, text)
    end)
  end
  for _, option in { "ignore", "consider" } do
    local names = plant[option]
    for _, name in if type(names) == "table" then names else { names } do
      if type(name) ~= "string" then
        refuse(`{option} of abop is {describe(name)}`, `write {option} = "+-F"`)
      end
      table.insert(texts, name)
    end
  end
  for _, letter in undeclared_letters(patterns, texts) do
    module(table.unpack(letter))
  end
  local object = plant.object
  local fields: { [string]: any } = {}
  for _, option in OF_TURTLE do
    fields[option] = plant[option]
  end
  if object == nil then
    object = turtle(fields)
  elseif next(fields) then
    refuse(
      `abop has an object, so {next(fields)} has no effect`,
      `give it to the object: object = turtle(\{ angle = 25.7 })`
    )
  end
  local system = lsystem({ object = object })
  for _, option in { "ignore", "consider" } do
    local names = plant[option]
    for _, name in if type(names) == "table" then names else { names } do
      system[option](system, name)
    end
  end
  for _, pattern in patterns do
    add_successors(pattern, plant[pattern], function(weight, text)
      if weight then
        system:rule(pattern, { weight = weight }, text)
      else
        system:rule(pattern, text)
      end
    end)
  end
  return system:axiom(plant.axiom)
end

-- The turtle's modules --------------------------------------------------------------------------------------
-- The symbols of The Algorithmic Beauty of Plants, for every system whose object is a turtle. Lengths are in metres,
-- angles in degrees. An omitted value is the turtle's own step, angle or width.

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
-- _ of cpfg: tilts towards the simple tropism with each step.
turtle_module("SimpleElasticity", "simple_elasticity", "elasticity?")
-- ~
names.Place = module("Place", "model", "scale?")
__interpretation("turtle", "Place", "place")

-- Shapes ----------------------------------------------------------------------------------------------------

-- Draws the faces of a shape, in a colour unless they have their own.
names.Draw = module("Draw", "shape", "color?")
__interpretation("turtle", "Draw", "shape")
__interpretation("extruder", "Draw", "shape")
__interpretation("footprint", "Draw", "shape")

local NO_VALUES: { any } = table.freeze({})

-- Entries of a split or a choice of components: the module or function of each, and its further values.
type Entries = { makers: { any }, values: { { any } } }

-- Makes the modules of a split or a choice of components at once; nil outside rules and for entries with functions.
local modules_of_parts: (method: string, shape: any, kind: string, parts: { any }) -> any = __modules_of_parts

--- Adds an entry, { size or selector, Module, values... }, and returns its first value.
local function add_entry(to: Entries, owner: string, part: any): any
  local usage = if owner == "split"
    then "write { 3, Floor }, or { 3, false } to leave the part empty"
    else 'write { "side", Wall }, or { "side", false } to leave these out'
  if type(part) ~= "table" or part[1] == nil then
    local first = if owner == "split" then "size" else "selector"
    local what = if type(part) == "table" then `has no {first}` else `is {describe(part)}`
    refuse(`{owner}: a part {what}`, usage)
  elseif part[2] == nil then
    refuse(`{owner}: an entry has no module`, usage)
  end
  table.insert(to.makers, part[2])
  table.insert(to.values, if part[3] == nil then NO_VALUES else { table.unpack(part, 3) })
  return part[1]
end

--- Adds what a part becomes: a module with the part and further values, all that a function returns, or nothing.
local function add_part(list: { any }, entries: Entries, number: number, part: any)
  local maker = entries.makers[number]
  if maker == false then
    return
  end
  for _, item in { maker(part, table.unpack(entries.values[number])) } do
    table.insert(list, item)
  end
end

--- Makes the modules of the parts that a method of a shape returns: entry number `i` becomes a module of maker `i`.
local function modules_of(entries: Entries, method: string, shape: any, ...: any): any
  local list: { any } = {}
  for _, part in shape[method](shape, ...) do
    add_part(list, entries, part:entry(), part)
  end
  return sequence(list)
end

--- Divides a shape along an axis of its scope into modules: each part is { size, Module }, a list of such parts is
--- repeated, and false instead of the module leaves the part empty. Further values of a part, as in { 2, Draw, "red" },
--- become further parameters.
local function split(shape: any, axis: string, parts: { any }): any
  local made = modules_of_parts("shape:split", shape, axis, parts)
  if made ~= nil then
    return made
  end
  local entries: Entries, sizes: { any } = { makers = {}, values = {} }, {}
  for _, part in parts do
    if type(part) == "table" and type(part[1]) == "table" then
      local group = {}
      for _, inner in part do
        table.insert(group, add_entry(entries, "split", inner))
      end
      table.insert(sizes, group)
    else
      table.insert(sizes, add_entry(entries, "split", part))
    end
  end
  return modules_of(entries, "split", shape, axis, sizes)
end

--- Divides a shape into modules for its components, "faces", "edges", "holes" or "pieces": each of `parts` is
--- { selector, Module }, and a component becomes the first whose selector it matches. Components without a match are left
--- out. A selector is a name or a function. Further values become further parameters, as for `split`.
local function components(shape: any, kind: string, parts: { any }): any
  local made = modules_of_parts("shape:components", shape, kind, parts)
  if made ~= nil then
    return made
  end
  local entries: Entries, selectors: { any }, are_names = { makers = {}, values = {} }, {}, true
  for _, part in parts do
    local selector = add_entry(entries, "components", part)
    table.insert(selectors, selector)
    are_names = are_names and type(selector) ~= "function"
  end
  if are_names then
    return modules_of(entries, "components", shape, kind, selectors)
  end
  local list: { any } = {}
  for _, component in shape:components(kind, { "all" }) do
    for number, selector in selectors do
      local matches = if type(selector) == "function"
        then selector(component)
        else component:matches(selector)
      if matches then
        add_part(list, entries, number, component)
        break
      end
    end
  end
  return sequence(list)
end

-- Pruning ---------------------------------------------------------------------------------------------------

-- %
--- Creates a module that erases itself and everything that follows it in its branch, at the beginning of the next step.
--- Until then, the modules are drawn.
names.Cut = module("Cut")
__cut("Cut")

names.vec = vec
names.polar = polar
names.lerp = lerp
names.remap = remap
names.ease = ease
names.noise = noise
names.hsv = hsv
names.rgb = rgb
names.mix = mix
names.prototype = prototype
names.abop = abop
names.split = split
names.components = components
table.freeze(Vec)
return names
