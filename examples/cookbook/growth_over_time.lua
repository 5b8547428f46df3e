--!strict
-- A sunflower over time: every size is a function of age, so each moment has its own model.
-- burgeon run growth_over_time.lua --frames time=0:30:0.5 -o growth.gif
local now = param("time", { default = 30, min = 0, max = 40, unit = "days", doc = "Age of the plant" })

local Apex, Internode, Leaf, Head =
  module("Apex", "born"), module("Internode", "born"), module("Leaf", "born"), module("Head", "born")

-- From 0 to 1 in about ten days: slow, fast, slow.
local growth = ramp({ { 0, 0 }, { 2, 0.1 }, { 7, 0.85 }, { 12, 1 } })

local plant = lsystem({ object = turtle({ color = "#6f9040", sides = 10 }) })
plant:axiom(Apex(0))
-- An internode each two days, until the head appears on day 16. A module knows the day of its birth.
plant:rule("Apex(born)", function(this, born)
  if born > now then
    return
  elseif born >= 16 then
    return Internode(born), Head(born)
  end
  return Internode(born), { Leaf(born) }, Roll(137.5), Apex(born + 2)
end)

plant:interpret("Internode(born)", function(this, born)
  local size = growth:at(now - born)
  this:width(0.02 + 0.03 * size):forward(0.02 + 0.2 * size):turn(1.5 * size)
end)
plant:interpret("Leaf(born)", function(this, born)
  local size = 0.55 * growth:at(now - born)
  this:color("#5c8a38"):pitch(25 + 50 * growth:at((now - born) / 2))
  this:mesh(
    {
      { 0, 0, 0 },
      { 0.32 * size, 0.1 * size, 0.4 * size },
      { 0, 0, 0.4 * size },
      { -0.32 * size, 0.1 * size, 0.4 * size },
      { 0, -0.1 * size, size },
    },
    { { 1, 3, 2 }, { 2, 3, 5 }, { 1, 4, 3 }, { 3, 4, 5 }, { 2, 3, 1 }, { 5, 3, 2 }, { 3, 4, 1 }, { 5, 4, 3 } }
  )
end)
plant:interpret("Head(born)", function(this, born)
  local size = growth:at(now - born)
  this:turn(40 * size):color("#6b4a2a"):width(0.34 * size):forward(0.05 * size)
  this:color("#f2b824")
  for number = 1, 2 * 14 do
    local petal = (0.2 + 0.04 * (number % 2)) * size
    this:roll(360 / 28):mesh({
      { 0, 0.13 * size, 0 },
      { 0.045 * size, 0.2 * size, 0 },
      { 0, 0.15 * size + petal, 0.03 },
      { -0.045 * size, 0.2 * size, 0 },
    }, { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } })
  end
end)

plant:derive()
