--!strict
-- Continuous growth and random branching: an apex makes an internode, with a branch by chance, when it is due.
-- Source: L-Py, training/08-continuous-growth+branching, F. Boudon and C. Godin.
local time = param("time", { default = 8, min = 0, max = 10, doc = "Age of the plant" })
local plastochron = param("plastochron", { default = 0.5, min = 0.1, max = 2, doc = "Time of an internode" })
local branching = param("branching", { default = 0.8, min = 0, max = 1, doc = "Chance of a branch" })
local ranks =
  param("ranks", { default = 8, min = 1, max = 12, step = 1, doc = "Internodes of the main axis" })
local STEP, JUMP = 0.1, 3 -- of time; ranks by which a branch is shorter

local Apex, Internode, Flower =
  module("Apex", "rank", "wait"), module("Internode", "age"), module("Flower", "age")

local plant = lsystem({ object = turtle({ width = 0.1, color = "#6f8f3f" }), interpret = "last" })
plant:axiom(Apex(0, plastochron))
plant:rule("Apex(rank, wait)", function(this, rank, wait): any
  if rank >= ranks then
    return Flower(0)
  elseif wait > STEP / 2 then
    return Apex(rank, wait - STEP)
  elseif random() < branching then
    local side = if rank % 2 == 0 then 60 else -60
    return Internode(0), { Turn(side), Apex(rank + JUMP, plastochron) }, Apex(rank + 1, plastochron)
  end
  return Internode(0), Apex(rank + 1, plastochron)
end)
plant:rule("Internode(age)", function(this, age: number)
  return Internode(math.min(age + STEP, 1))
end)
plant:rule("Flower(age)", function(this, age: number)
  return Flower(math.min(age + STEP, 1))
end)
plant:interpret("Internode(age)", function(this, age)
  return Width(0.02 + 0.1 * age), F(age)
end)
plant:interpret("Flower(age)", function(this, age)
  return Color("#e08a2f"), G(0.3 * age), Sphere(0.3 * age)
end)
local result = plant:derive(time / STEP)

-- The main axis has eight internodes of length 1 and its flower. A branch has three internodes less than its axis.
expect(result.objects[1]:position().z, 8.3, 1e-9)
local function most(internodes: number): number
  local sum = internodes
  for rank = 1, internodes do
    sum += most(math.max(internodes - rank - 2, 0))
  end
  return sum
end
expect(result.counts.Internode <= most(8), true)
expect(result.counts.Apex, 0)
-- Picture: --azimuth 180 --elevation 0
