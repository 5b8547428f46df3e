--!strict
-- A sunflower head: the number of a primordium decides on its organ, from seeds in the middle to florets and petals.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.7.
local organs = param("organs", { default = 630, min = 100, max = 1500, step = 1, doc = "Number of organs" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "Between organs" })
local petals = param("petals", { default = "#f2b422", doc = "Colour of the petals" })

-- A petal of 1 m along the heading, with two sides that meet in a fold.
local function petal(color: any): any
  local system = lsystem({ object = turtle({ color = color, roughness = 0.6 }) })
  local function half(side: number): any
    return {
      Roll(side * 14),
      BeginPolygon(),
      Point(),
      { Turn(side * 22), G(0.42), Point() },
      { Turn(side * 13), G(0.75), Point() },
      { G(1), Point() },
      EndPolygon(),
    }
  end
  system:axiom(half(1), half(-1))
  return system:derive()
end
local yellow, green = petal(petals), petal("#5f8f3c")

local Apex, Disc = module("Apex", "n"), module("Disc")
local Seed, Floret, Petal, Bract =
  module("Seed", "n"), module("Floret"), module("Petal", "ring"), module("Bract")

-- Four rings of 15 petals.
local function organ(n: number): any
  if n <= 440 then
    return Seed(n)
  elseif n <= 565 then
    return Floret()
  elseif n <= 625 then
    return Petal((n - 566) // 15)
  end
  return Bract()
end

local head = lsystem({ object = turtle({ sides = 6 }), interpret = "last" })
head:axiom({ Disc() }, Apex(1))
head:rule("Apex(n)", function(this, n: number)
  return { Turn(divergence * n), G(math.sqrt(n)), organ(n) }, Apex(n + 1)
end)

-- The turtle heads outwards; the head faces the direction of the turtle's up, and petals lean towards it.
-- A disc behind the organs closes the gaps.
head:interpret("Disc", function(this)
  this:pitch(90):advance(0.4):pitch(-90):color("#4a5a20"):begin_polygon()
  for _ = 1, 36 do
    this:turn(10):advance(29):point():advance(-29)
  end
  this:end_polygon()
end)
head:interpret("Seed(n)", function(this, n: number)
  this:color(mix("#6b4a22", "#2f2013", n // 40 / 11)):sphere(1.05)
end)
head:interpret("Floret", function()
  return Color("#8a5a1c"), Sphere(1.05), Up(60), Width(0.5), F(1.6), Color("#e0a52c"), Sphere(0.5)
end)
-- The outer rings are flatter, and the bracts are behind them.
head:interpret("Petal(ring)", function(this, ring: number)
  return Up(38 - ring * 12), Place(yellow, 15)
end)
head:interpret("Bract", function()
  return Up(-10), Place(green, 9)
end)

-- A step makes one organ.
local derived = head:derive(organs)
local counts = derived.counts
expect({ counts.Seed, counts.Floret, counts.Petal, counts.Bract }, { 440, 125, 60, 5 })

-- The place of an organ in Vogel's formula: above it is the topmost point of a seed or floret.
local function place(n: number): any
  local turn = math.rad(divergence * n)
  return vec(-math.sin(turn), 0, math.cos(turn)) * math.sqrt(n)
end
for n = 1, 440 + 125 do
  expect(derived.objects[1]:distance(place(n) + vec(0, 0, 1.05)), 0, 1e-5)
end
-- The organs nearest to the last one are 34, 55 and 89 older: the numbers of the visible spirals.
local last = place(organs)
local older: { number } = {}
for n = 1, organs - 1 do
  table.insert(older, n)
end
table.sort(older, function(a: number, b: number)
  return last:distance(place(organs - a)) < last:distance(place(organs - b))
end)
expect({ older[1], older[2], older[3] }, { 55, 89, 34 })

-- Picture: --azimuth 180 --elevation 0
