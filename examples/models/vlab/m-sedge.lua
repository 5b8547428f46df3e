--!strict
-- A sedge: internodes grow exponentially and divide at twice their length, and the stem becomes thicker. Nodes bear
-- a leaf and a female spike, and the stem ends in a male spike. Leaves and spikes are sub-systems: in each of them, the same
-- modules grow by other rules.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Sedge, University of Calgary.
local steps = param("steps", { default = 95, min = 0, max = 120, step = 1, doc = "Steps of growth" })
local stems = param("stems", { default = 5, min = 1, max = 12, step = 1, doc = "Stems of the tuft" })
local RATE, STEM_RATE = 1.02, 1.06 -- growth of internodes and of the stem's width in a step
local DELAY, LAST = 10, 30 -- steps between nodes, and the age of the apex at its end

local Apex, Stem = module("Apex", "age", "wait"), module("Stem", "width")
local LeafBud, SpikeBud = module("LeafBud", "age"), module("SpikeBud", "age")
local Tip, Bud = module("Tip", "age"), module("Bud")
local Bract, Chaff, Stamen = module("Bract", "size"), module("Chaff", "size"), module("Stamen", "size")
local Midrib, Segment = module("Midrib"), module("Segment", "length", "width")
local Blade = module("Blade", "wait", "left", "elasticity")
local InFemale, InMale, InLeaf = module("InFemale", "scale"), module("InMale", "scale"), module("InLeaf")

local pen = turtle({ color = "#5f8f45", sides = 6, simple_tropism = { 0.2, 0, 1 }, simple_elasticity = 0.02 })
local sedge = lsystem({ object = pen, interpret = "last" })
local female, male, leaf = lsystem({ object = pen }), lsystem({ object = pen }), lsystem({ object = pen })
sedge:subsystem("InFemale", female):subsystem("InMale", male):subsystem("InLeaf", leaf)

-- The stem.
local tuft: { any } = {}
for k = 1, stems do
  table.insert(tuft, { Roll(k * 137.5), Pitch(4 + 3 * k), Stem(0.0075), Apex(4, 4) })
end
sedge:axiom(sequence(tuft))
sedge:rule("Apex(age, wait)", function(this, age: number, wait: number): any
  if age == LAST then
    return F(1), Roll(137.5), InMale(1.25), Tip(-1)
  elseif wait < DELAY then
    return F(1), Apex(age + 1, wait + 1)
  end
  return F(1), Roll(137.5), { LeafBud(age) }, { SpikeBud(age) }, Stem(0.0075), Apex(age + 1, 0)
end)
sedge:rule("SpikeBud(age)", function(this, age: number)
  local half = F((LAST - age) / 5)
  return Pitch(-25),
    SimpleElasticity(-0.1),
    Width(0.3),
    half,
    half,
    SimpleElasticity(0),
    InFemale(1.25),
    Tip(-1)
end)
sedge:rule("LeafBud(age)", function(this, age: number)
  return Pitch(-60), Width(0.1), InLeaf(), Midrib(), Blade(age - 9, age, (age - 13) / 100)
end)
sedge:rule("F(size)", function(this, size: number): any
  if size < 2 then
    return F(size * RATE)
  end
  return F(size * RATE / 2), F(size * RATE / 2)
end)
sedge:rule("Stem(width)", function(this, width: number)
  return Stem(math.min(width * STEM_RATE, 0.4))
end)
sedge:interpret("Stem(width)", function(this, width)
  this:width(width * 2)
end)

-- A rule of a spike grows an organ by a rate up to a size.
local function grow(spike: System<Turtle>, organ: string, symbol: string, rate: number, most: number)
  local options: any = {
    when = function(this, x: number)
      return x < most
    end,
  }
  spike:rule(`{organ}(x)`, options, `{symbol}(x * {rate})` :: any)
end

-- The tip of a spike makes this number of buds.
local function bud(spike: System<Turtle>, count: number)
  local options: any = {
    when = function(this, age: number)
      return age >= 0 and age < count
    end,
  }
  spike:rule("Tip(age)", options, "F(0.2) [Bud] /(137.5) Tip(age + 1)" :: any)
end

-- A female spike: bracts and chaff in spiral order, which bend down as they grow.
female:rule(
  "Tip(-1)",
  "[&(30) /(180) Bract(2.25) #(0.1) F(0.5)] F(0.1) /(180) [&(30) /(180) Bract(2.25) #(0.1) F(0.5)] /(137.5) Tip(0)"
)
bud(female, 75)
female:rule("Bud", "&(35) [Bract(1)] /(180) [Bract(1)] [Chaff(1) #(0.1) F(0.5)]")
grow(female, "Down", "&", 1.05, 50)
grow(female, "Bract", "Bract", 1.05, 2)
grow(female, "Chaff", "Chaff", 1.05, 2)
grow(female, "F", "F", 1.01, 1)

-- A male spike: stamens in spiral order.
male:rule("Tip(-1)", "Tip(0)")
bud(male, 55)
male:rule("Bud", "^(5) [Stamen(1)]")
grow(male, "Up", "^", 1.02, 15)
grow(male, "Stamen", "Stamen", 1.02, 3)
grow(male, "F", "F", 1.025, 1)

-- A leaf: after a delay, its blade gets a segment in each step. It rises at first. When it has as many segments as the age
-- of the stem's apex at its node, its elasticity changes: the lower leaf then bends down, and the upper one further up.
leaf:rule("Blade(wait, left, elasticity)", function(this, wait: number, left: number, elasticity: number): any
  if wait > 0 then
    return Blade(wait - 1, left, elasticity)
  elseif left == 0 then
    return SimpleElasticity(elasticity), Segment(0.16, 0.05), Blade(0, -1, elasticity)
  end
  return Segment(0.16, 0.05), Blade(0, left - 1, elasticity)
end)
leaf:rule("Segment(length, width)", function(this, length: number, width: number)
  return Segment(math.min(length * 1.05, 1.1), math.min(width * 1.08, 4))
end)

-- The organs are pointed and a little hollow.
local scale = surface({
  points = {
    { vec(0, 0, 0), vec(-0.3, 0.05, 0.4), vec(0, 0.1, 1) },
    { vec(0, 0, 0), vec(0, -0.15, 0.4), vec(0, 0.1, 1) },
    { vec(0, 0, 0), vec(0.3, 0.05, 0.4), vec(0, 0.1, 1) },
  },
  kind = "b-spline",
  degree = 2,
  divisions = 2,
})
female:interpret("Bract(size)", function(this, size)
  this:color("#5d8f3a"):surface(scale, vec(2.4, 2, 1.6) * size)
end)
female:interpret("Chaff(size)", function(this, size)
  this:color("#4a6f2c"):surface(scale, vec(2, 2, 1.4) * size)
end)
male:interpret("Stamen(size)", function(this, size)
  this:color("#b8893c"):surface(scale, vec(3, 3, 1.2) * size)
end)
local rim: { Vector } = {}
for k = 1, 8 do
  rim[k] = vec(math.cos(k * math.pi / 4), 0.1 * math.sin(k * math.pi / 4), 0)
end
local section = curve(rim, { closed = true })
leaf:interpret("Midrib", function(this)
  this:color("#4f8440"):contour(section):begin_cylinder()
end)
leaf:interpret("Segment(length, width)", function(this, length, width)
  this:width(width):forward(length)
end)
local result = sedge:derive(steps)

-- The apex has the age 4 at the start and 30 at its end, and makes nodes at the ages 10 and 21, in steps 7 and 18. Their
-- spikes begin two steps later, and make 75 buds one step after another; the last bud of the second is still closed.
expect({ result.counts.InLeaf, result.counts.InFemale, result.counts.InMale }, { 5 * 2, 5 * 2, 5 })
expect(
  { result.counts.Bract, result.counts.Chaff, result.counts.Bud },
  { 5 * (2 + 150 + 2 + 148), 5 * 149, 5 }
)
expect(result.counts.Stamen, 5 * 55)
-- The blades begin in steps 10 and 32.
expect(result.counts.Segment, 5 * (86 + 64))
-- Divisions change no length: the internode of step n has the length 1.02^(95 - n).
local length, sum = 0, 0
for n = 1, 27 do
  length += RATE ^ (95 - n)
end
for _, stem in result:chain() do
  for _, item in stem do
    if item.name == "InMale" then
      break
    elseif item.name == "F" then
      sum += item.length
    end
  end
end
expect(sum, 5 * length, 1e-9)
-- Picture: --azimuth 160 --elevation 20
