--!strict
-- A sedge: internodes grow exponentially and divide at twice their length, and the stem becomes thicker. Nodes bear
-- a leaf and a female spike, and the stem ends in a male spike. Leaves and spikes are systems of their own.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Sedge, University of Calgary.
local steps = param("steps", { default = 95, min = 0, max = 120, step = 1, doc = "Steps of growth" })
local stems = param("stems", { default = 5, min = 1, max = 12, step = 1, doc = "Stems of the tuft" })
local RATE, STEM_RATE = 1.02, 1.06 -- growth of internodes and of the stem's width in a step
local DELAY, LAST = 10, 30 -- steps between nodes, and the age of the apex at its end

local Apex, Internode = module("Apex", "age", "wait"), module("Internode", "size")
local Leaf, Spike, Male = module("Leaf", "age"), module("Spike", "age"), module("Male", "age")
local Stem = module("Stem", "width")

-- A spike of 1 m: scales around an axis in spiral order.
local Scale = module("Scale", "left")
local function spike(color: string, thickness: number): Derived
  local system = lsystem({ object = turtle({ color = color, sides = 5, width = thickness / 3 }) })
  system:axiom(Scale(36))
  system:rule("Scale(left)", function(this, left: number): any
    if left == 0 then
      return nil
    end
    local size = thickness * math.sin(math.pi * (0.1 + 0.85 * left / 36))
    return F(1 / 36), { Pitch(35), G(size * 0.5), Sphere(size * 0.3) }, Roll(137.5), Scale(left - 1)
  end)
  return system:derive()
end
local female, male = spike("#7a8f4a", 0.22), spike("#a8783f", 0.12)

-- A narrow blade of 1 m, which bends to its tip.
local blade_rows: { { Vector } } = {}
local place = vec(0, 0, 0)
for k = 0, 8 do
  local half, angle = 0.035 * math.sin(math.pi * (0.15 + 0.85 * k / 8)), math.rad(80 * (k / 8) ^ 1.5)
  blade_rows[k + 1] = { place - vec(half, 0.4 * half, 0), place, place + vec(half, -0.4 * half, 0) }
  place += vec(0, math.sin(angle), math.cos(angle)) / 8
end
local blade = surface({ points = blade_rows, kind = "b-spline", degree = 2, divisions = 2 })

local sedge = lsystem({ object = turtle({ color = "#5f8f45", sides = 6 }), interpret = "last" })
local tuft: { any } = {}
for k = 1, stems do
  table.insert(tuft, { Roll(k * 137.5), Pitch(4 + 3 * k), Stem(0.0075), Apex(4, 4) })
end
sedge:axiom(sequence(tuft))
sedge:rule("Apex(age, wait)", function(this, age: number, wait: number): any
  if age == LAST then
    return Internode(1), Male(0)
  elseif wait < DELAY then
    return Internode(1), Apex(age + 1, wait + 1)
  end
  return Internode(1), Roll(137.5), { Leaf(0) }, { Spike(0) }, Apex(age + 1, 0)
end)
sedge:rule("Internode(size)", function(this, size: number): any
  if size < 2 then
    return Internode(size * RATE)
  end
  return Internode(size * RATE / 2), Internode(size * RATE / 2)
end)
sedge:rule("Stem(width)", function(this, width: number)
  return Stem(math.min(width * STEM_RATE, 0.5))
end)
for _, organ in { { "Leaf", Leaf }, { "Spike", Spike }, { "Male", Male } } :: { any } do
  sedge:rule(`{organ[1]}(age)`, function(this, age: number)
    return organ[2](age + 1)
  end)
end
sedge:interpret("Stem(width)", function(this, width)
  this:width(width * 2)
end)
sedge:interpret("Internode(size)", function(this, size)
  this:forward(size)
end)
sedge:interpret("Leaf(age)", function(this, age)
  local size = ease.smooth(math.min(age / 60, 1))
  this:color("#4f8440"):pitch(12 + 25 * size):surface(blade, 70 * size)
end)
sedge:interpret("Spike(age)", function(this, age)
  local size = ease.smooth(math.min(age / 60, 1))
  this:pitch(-18):width(0.5):forward(8 * size):place(female, 22 * size)
end)
sedge:interpret("Male(age)", function(this, age)
  this:place(male, 24 * ease.smooth(math.min(age / 60, 1)))
end)
local result = sedge:derive(steps)

-- The apex has the age 4 at the start and 30 at its end, and makes nodes at the ages 10 and 21.
expect({ result.counts.Leaf, result.counts.Spike, result.counts.Male }, { 5 * 2, 5 * 2, 5 })
-- Divisions change no length: the internode of step n has the length 1.02^(95 - n).
local length = 0
for n = 1, 27 do
  length += RATE ^ (95 - n)
end
local sum = 0
for size in string.gmatch(result.chains[1], "Internode%(([^)]+)%)") do
  sum += tonumber(size) :: number
end
expect(sum, 5 * length, 1e-9)
-- Picture: --azimuth 180 --elevation 8
