--!strict
-- An orchid: basal leaves, a curved stem with open and closed flowers, sepals, petals and a lip from curved surfaces.
-- Source: L-Py, tutorial/10 - graphics/orchidee, F. Boudon and C. Godin.
local internodes = param("internodes", { default = 13, min = 2, max = 30, step = 1, doc = "Of the stem" })
local flowers = param("flowers", { default = 8, min = 0, max = 20, step = 1, doc = "Flowers of the stem" })
local closed = param("closed", { default = 4, min = 0, max = 20, step = 1, doc = "Flowers that are closed" })
local basal = param("basal", { default = 5, min = 0, max = 12, step = 1, doc = "Leaves at the ground" })
local sepals = param("sepals", { default = "#c98fc4", doc = "Colour of the sepals" })
local LENGTH, PHYLLOTAXIS = 10, 137.5 -- of an internode; between organs (degrees)

local Stem, Leaf = module("Stem", "number"), module("Leaf", "length", "angle")
local Flower, Bud = module("Flower", "number"), module("Bud", "number")
local Basal, Internode, End = module("Basal", "left"), module("Internode", "length", "width"), module("End")

-- A blade of 1 m: widest at `wide`, with raised sides, and bent back by `bend` (degrees).
local function blade(width: number, wide: number, raised: number, bend: number): Surface
  local shape = ramp({ { 0, 0.25 }, { wide, 1 }, { 1, 0 } })
  local rows: { { Vector } } = {}
  local place = vec(0, 0, 0)
  for k = 0, 6 do
    local t = k / 6
    local half, angle = width * shape:at(t), math.rad(bend * t)
    local up = vec(0, -math.cos(angle), math.sin(angle)) * (raised * half)
    rows[k + 1] = { place - vec(half, 0, 0) + up, place, place + vec(half, 0, 0) + up }
    place += vec(0, math.sin(angle), math.cos(angle)) / 6
  end
  return surface({ points = rows, kind = "b-spline", degree = 2, divisions = 2 })
end
local leaf, sepal = blade(0.14, 0.4, 0.5, 60), blade(0.28, 0.5, 0.3, 35)
local petal, lip = blade(0.2, 0.5, 0.2, 60), blade(0.42, 0.7, -0.5, 110)

local thickness = ramp({ { 0, 1.5 }, { 0.5, 1 }, { 1, 0.35 } })
local lean = ramp({ { 0, 1 }, { 0.5, 3 }, { 1, -2 } })

local plant = lsystem({ object = turtle({ color = "#5f8440", sides = 10, width = 1.5 }), interpret = "last" })
plant:axiom(Basal(basal), Stem(0))
plant:decompose("Basal(left)", function(this, left: number): any
  if left == 0 then
    return nil
  end
  return Roll(PHYLLOTAXIS), { Leaf(60, 35 + random(0, 30)) }, Basal(left - 1)
end)
plant:decompose("Stem(number)", function(this, number: number): any
  if number == internodes then
    return End()
  end
  local part = Internode(LENGTH, thickness:at(number / internodes))
  if number < internodes - flowers then
    return part, { Roll(number * PHYLLOTAXIS), Leaf(18, 25) }, Stem(number + 1)
  end
  local is_closed = number >= internodes - closed
  local organ = if is_closed then Bud(number) else Flower(number)
  local length = if is_closed then LENGTH / 2 else LENGTH
  return Internode(length, thickness:at(number / internodes)),
    { Roll(number * PHYLLOTAXIS), Leaf(9, 30) },
    { Roll(number * PHYLLOTAXIS), organ },
    Stem(number + 1)
end)
plant:interpret("Internode(length, width)", function(this, length, width)
  this:turn(lean:at(this:position().z / (LENGTH * internodes))):width(width):forward(length)
end)
plant:interpret("End", function(this)
  this:sphere(0.25)
end)
plant:interpret("Leaf(length, angle)", function(this, length, angle)
  this:color("#4f8440"):pitch(angle):surface(leaf, length)
end)
plant:interpret("Bud(number)", function(this)
  this:pitch(40):width(0.5):forward(3):pitch(-15):forward(3):color(mix(sepals, "#7f9f5a", 0.4))
  for _ = 1, 3 do
    this:roll(120):pitch(12):surface(sepal, 5):pitch(-12)
  end
end)
plant:interpret("Flower(number)", function(this)
  this:pitch(50):width(0.6):forward(4):pitch(25):forward(3):roll(180)
  for _ = 1, 3 do
    this:roll(120):pitch(65):color(sepals):surface(sepal, 8):pitch(-65)
  end
  this:roll(60)
  for _ = 1, 2 do
    this:roll(120):pitch(55):color(mix(sepals, "#7a3f7f", 0.4)):surface(petal, 6):pitch(-55)
  end
  this:roll(120):pitch(35):color("#5a2f2a"):surface(lip, 8):pitch(-35)
end)
local result = plant:derive(0)

-- Four of the eight flowers are open, and each node has a leaf.
expect(result.counts, { Flower = 4, Bud = 4, Internode = 13, Leaf = 5 + 13, End = 1, Roll = 5 + 13 + 8 })
-- Picture: --azimuth 200 --elevation 10
