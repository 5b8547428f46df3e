--!strict
-- The florets of a sunflower, after Vogel's formula: the floret n is at the angle 137.5 n and the distance c sqrt(n).
-- Source: Virtual Laboratory (cpfg), Open/05-phyllotaxis-Vogel, University of Calgary.
local florets = param("florets", { default = 500, min = 1, max = 1500, step = 1, doc = "Number of florets" })
local angle =
  param("angle", { default = 137.5, min = 130, max = 145, unit = "deg", doc = "Divergence angle" })
local spacing =
  param("spacing", { default = 0.5, min = 0.1, max = 1, unit = "m", doc = "Distance of the first floret" })

local Apex, Floret = module("Apex", "n"), module("Floret", "n")

local head =
  lsystem({ object = turtle({ heading = { 0, 1, 0 }, sides = 8 }), interpret = "last", max_depth = 1500 })
head:axiom(Apex(0))
head:decompose("Apex(n)", {
  when = function(this, n)
    return n < florets
  end,
}, function(this, n)
  return { Turn(n * angle), G(spacing * math.sqrt(n)), Floret(n) }, Apex(n + 1)
end)
head:interpret("Floret(n)", function(this, n)
  local age = n / florets
  return Color(mix("#6b4a1f", "#f0c32e", age)), Sphere(0.455)
end)
local flower = head:derive(0)

-- A disc with n florets has the radius c sqrt(n), so each floret has the area pi c^2 and spheres of 0.91 c touch.
expect(flower.counts.Floret, 500)

-- The topmost point of each sphere is above the place in the formula.
local function place(n: number): any
  local turn = math.rad(angle * n)
  return vec(-math.sin(turn), math.cos(turn), 0) * spacing * math.sqrt(n)
end
for n = 0, florets - 1 do
  expect(flower.objects[1]:distance(place(n) + vec(0, 0, 0.455)), 0, 1e-6)
end
-- At the edge, the florets next to a floret are 34, 55 and 89 older: the numbers of the visible spirals.
local last = place(florets - 1)
local older: { number } = {}
for n = 1, florets - 1 do
  table.insert(older, n)
end
table.sort(older, function(a: number, b: number)
  return last:distance(place(florets - 1 - a)) < last:distance(place(florets - 1 - b))
end)
expect({ older[1], older[2], older[3] }, { 55, 34, 89 })
-- Picture: --azimuth 180 --elevation 60
