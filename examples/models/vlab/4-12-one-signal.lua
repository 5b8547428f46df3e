--!strict
-- Flowering by one signal, which rises from the base faster than branches grow: if it is slow in the branches, the
-- uppermost ones flower first (basipetal); with the same rate everywhere, the lowest ones do (acropetal).
-- Source: Virtual Laboratory (cpfg), Signaling/12-basipetal-1-signal and 11-acropetal-1-signal, University of Calgary,
-- after J. Janssen and A. Lindenmayer, Models for the control of branch positions and flowering sequences, 1987.
local steps = param("steps", { default = 30, min = 0, max = 60, step = 1, doc = "Steps of growth" })
local delay =
  param("delay", { default = 10, min = 0, max = 30, step = 1, unit = "steps", doc = "Delay of the signal" })
local main =
  param("main", { default = 2, min = 1, max = 8, step = 1, unit = "steps", doc = "Plastochron of the axis" })
local side =
  param("side", { default = 5, min = 1, max = 8, step = 1, unit = "steps", doc = "Plastochron of branches" })
local rate = { [0] = 1, 3 } -- steps of the signal per internode in the axis and in branches

local Base, Signal = module("Base", "age"), module("Signal", "age")
local Apex, Internode = module("Apex", "age", "order"), module("Internode", "order", "is_reached")
local Leaf, Flower = module("Leaf"), module("Flower", "age")

local plant = lsystem({ object = turtle({ angle = 36, width = 0.5 }), interpret = "last" })
plant:ignore("Turn", "Roll")
plant:axiom(Base(0), Internode(0, false), Apex(0, 0))
plant:rule("Base(age)", function(this, age)
  return if age < delay then Base(age + 1) else Signal(0)
end)
plant:rule("Signal(i) < Apex(age, order)", function()
  return Flower(0)
end)
plant:rule("Apex(age, order)", function(this, age, order)
  if age < (if order == 0 then main else side) - 1 then
    return Apex(age + 1, order)
  end
  local lateral = if order == 0 then { Turn(), Internode(1, false), Apex(0, 1) } else { Turn(), Leaf() }
  return lateral, Internode(order, false), Roll(180), Apex(0, order)
end)
plant:rule("Signal(age)", function(this, age)
  return if age < rate[0] + rate[1] then Signal(age + 1) else nil
end)
plant:rule("Signal(age) < Internode(order, is_reached)", {
  when = function(this, age, order)
    return age == rate[order] - 1
  end,
}, function(this, age, order)
  return Internode(order, true), Signal(0)
end)
plant:rule("Flower(age)", function(this, age: number)
  return Flower(age + 1)
end)
plant:interpret("Internode(order, is_reached)", function(this, order, is_reached)
  return Color(if is_reached then "#d8702f" else "#6f9a48"), F(3)
end)
plant:interpret("Leaf", function()
  return Color("#6f9a48"), F(1)
end)
plant:interpret("Apex", function()
  return Color("#4f7a35"), Sphere(0.4)
end)
plant:interpret("Flower", function()
  return Color("#e8c02f"), Sphere(1)
end)
local result = plant:derive(steps)

-- The signal is behind the internode k of the axis in step 11 + k, and behind the internode j of branch k in step
-- 11 + k + 3j. It flowers one step later, if the branch, which began in step 2k, has no further internode until then.
local flowers = 0
for k = 1, 11 do
  local j = 1
  while j < 1 + (11 - k + 3 * j) // 5 do
    j += 1
  end
  flowers += if 12 + k + 3 * j <= 30 then 1 else 0
end
-- The axis has twelve internodes and its own flower when it is reached, in step 24.
expect(result.counts.Flower, flowers + 1)
-- Picture: --azimuth 180 --elevation 0
