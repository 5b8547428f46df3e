--!strict
-- Florets in the golden angle: each one is 137.5 degrees from the one before, on a disc that grows with the root.
local florets =
  param("florets", { default = 420, min = 20, max = 1500, step = 10, doc = "Number of florets" })
local angle =
  param("angle", { default = 137.508, min = 130, max = 145, unit = "deg", doc = "Divergence angle" })

local Floret, Petal = module("Floret", "number"), module("Petal", "number")

local head = lsystem({ object = turtle({ sides = 8 }) })
local modules = {}
for number = 1, florets do
  table.insert(modules, { Floret(number) })
end
for number = florets, florets + 54 do
  table.insert(modules, { Petal(number) })
end
head:axiom(sequence(modules))

head:interpret("Floret(number)", function(this, number)
  local away, turn = 0.05 * math.sqrt(number), math.rad(number * angle)
  local part = number / florets
  this:color(mix("#8a6a1f", "#4a2f1b", math.min(1, 1.5 * part))):width(0.07)
  this:jump({ away * math.cos(turn), away * math.sin(turn), 0.22 * (1 - part * part) })
  this:forward(0.1):color(mix("#e0b53b", "#c98a2e", part)):width(0.02):forward(0.06)
end)
head:interpret("Petal(number)", function(this, number)
  local away, turn = 0.05 * math.sqrt(florets), number * angle
  this:pitch(90):color(choose({ "#f4c22e", "#efb321", "#f7cf4b" }))
  this:face(vec(math.cos(math.rad(turn)), math.sin(math.rad(turn)), random(0.05, 0.25))):level():advance(away)
  this:mesh(
    { { 0, 0, 0 }, { 0.1, 0.02, 0.28 }, { 0, 0, 0.7 }, { -0.1, 0.02, 0.28 } },
    { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } }
  )
end)

head:derive()
