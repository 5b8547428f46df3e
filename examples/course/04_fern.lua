--!strict
-- A fern: fronds in a rosette, and leaflets on both sides of each frond.
local fronds = param("fronds", { default = 14, min = 3, max = 30, step = 1, doc = "Number of fronds" })
local age =
  param("age", { default = 24, min = 4, max = 40, step = 1, doc = "Leaflets on each side of a frond" })

local Rosette = module("Rosette")
local Tip = module("Tip", "number")
local Stalk = module("Stalk", "number")
local Leaflet = module("Leaflet", "length")

-- The length (m) of a leaflet by its place on the frond, from 0 at the foot to 1 at the tip.
local outline = ramp({ { 0, 0.02 }, { 0.12, 0.15 }, { 0.4, 0.3 }, { 0.8, 0.15 }, { 1, 0.02 } })

local fern = lsystem({ object = turtle({ color = "#5d6b2f", sides = 6 }) })

fern:axiom(Rosette())

-- A list in the successor is a branch. The turtle returns to the middle at its end, then rolls to the next frond.
fern:rule("Rosette", function(this)
  local parts: { any } = {}
  for number = 1, fronds do
    local lean = if number % 2 == 0 then 24 else 44
    table.insert(parts, { Pitch(lean), Tip(0) })
    table.insert(parts, Roll(360 / fronds))
  end
  return sequence(parts)
end)

-- A tip becomes a piece of stalk, two leaflets and the next tip, and the frond bends down.
fern:rule("Tip(number)", {
  when = function(this, number)
    return number < age
  end,
}, function(this, number)
  local length = outline:at(number / age)
  return Stalk(number),
    { Turn(66), Leaflet(length) },
    { Turn(-66), Leaflet(length) },
    Pitch(0.6 + 4 * number / age),
    Tip(number + 1)
end)

fern:interpret("Stalk(number)", function(this, number)
  this:width(0.022 * (1 - number / age) + 0.003):forward(0.055)
end)

fern:interpret("Leaflet(length)", function(this, length)
  local half = 0.012 + 0.07 * length
  this:color(if length > 0.2 then "#4f8a3a" else "#6aa344"):pitch(12)
  this:mesh(
    {
      { 0, 0, 0 },
      { half, -0.01, length * 0.35 },
      { 0, 0.02, length * 0.4 },
      { -half, -0.01, length * 0.35 },
      { 0, -0.03, length },
    },
    { { 1, 2, 3 }, { 3, 2, 5 }, { 1, 3, 4 }, { 3, 5, 4 }, { 3, 2, 1 }, { 5, 2, 3 }, { 4, 3, 1 }, { 4, 5, 3 } }
  )
end)

fern:derive()
