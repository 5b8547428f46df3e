--!strict
-- A foxglove: a signal rises through the stem, and opens the flowers one after another.
local days = param("days", { default = 46, min = 0, max = 70, step = 1, unit = "days", doc = "Age" })
local start =
  param("start", { default = 20, min = 1, max = 40, step = 1, unit = "days", doc = "Day of the signal" })

local LEAVES, INTERNODES = 9, 34

local Root = module("Root", "age")
local Signal = module("Signal")
local Internode = module("Internode", "age")
local Apex = module("Apex", "number")
local Leaf = module("Leaf", "age")
local Bud = module("Bud", "open")

local foxglove = lsystem({ object = turtle({ color = "#7d9a52", sides = 10 }) })

-- Contexts look past the turns.
foxglove:ignore("Roll")

foxglove:axiom(Root(0), Apex(0))

-- The apex makes an internode with a leaf each day, and later with a bud.
foxglove:rule("Apex(number)", function(this, number)
  if number == INTERNODES then
    return
  end
  local organ = if number < LEAVES then Leaf(0) else Bud(0)
  return Internode(0), Roll(137.5), { organ }, Apex(number + 1)
end)

-- The root sends the signal.
foxglove:rule("Root(age)", function(this, age: number)
  if age == start then
    return Root(age + 1), Signal()
  end
  return Root(age + 1)
end)

-- In each step, the signal vanishes, and appears again above the next internode.
foxglove:rule("Signal", function(this)
  return nil
end)
foxglove:rule("Signal < Internode(age)", function(this, age: number)
  return Internode(age + 1), Signal()
end)
foxglove:rule("Internode(age)", function(this, age: number)
  return Internode(age + 1)
end)

-- A bud opens when the signal is at the foot of its branch. After that, it opens further each day.
foxglove:rule("Signal < Bud(open)", function(this, open)
  return Bud(1)
end)
foxglove:rule("Bud(open)", function(this, open: number)
  if open == 0 or open == 10 then
    return
  end
  return Bud(open + 1)
end)
foxglove:rule("Leaf(age)", function(this, age: number)
  return Leaf(age + 1)
end)

-- Functions of age: everything grows slowly, then fast, then slowly.
local growth = ramp({ { 0, 0.05 }, { 5, 0.3 }, { 14, 0.9 }, { 24, 1 } })
local blade = surface({
  { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } },
  { { -0.13, 0.07, 0.12 }, { -0.04, -0.03, 0.12 }, { 0.04, -0.03, 0.12 }, { 0.13, 0.07, 0.12 } },
  { { -0.17, 0, 0.3 }, { -0.05, -0.06, 0.3 }, { 0.05, -0.06, 0.3 }, { 0.17, 0, 0.3 } },
  { { 0, -0.12, 0.46 }, { 0, -0.12, 0.46 }, { 0, -0.12, 0.46 }, { 0, -0.12, 0.46 } },
})

foxglove:interpret("Internode(age)", function(this, age)
  this:width(0.006 + 0.016 * growth:at(age)):forward(0.026 * growth:at(age))
end)
foxglove:interpret("Leaf(age)", function(this, age)
  this:color("#5e8a44"):pitch(40 + age):surface(blade, 0.75 * growth:at(age))
end)
-- A bud is a green drop. It becomes a bell that hangs down, pink outside and pale at its mouth.
foxglove:interpret("Bud(open)", function(this, open)
  local part = open / 10
  local size = 0.016 + 0.034 * part
  this:color("#8fab5f"):width(0.006):pitch(50):forward(0.012):pitch(20 + 50 * part)
  this:color(mix("#9db06a", "#c2569c", math.min(1, 2 * part)))
  this:width(size * 0.8):forward(0.018 + 0.018 * part):width(size):forward(0.012 + 0.036 * part)
  if open > 3 then
    this:width(size * 1.45):forward(0.014):color("#f0d3e4"):width(size * 1.2):forward(0.001)
  end
end)

foxglove:derive(days)
