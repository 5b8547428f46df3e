--!strict
-- A compound leaf in continuous time: ages grow by small steps, and decomposition divides an apex when it is due.
-- Source: Virtual Laboratory (cpfg), Introduction/09-continuous-decomp, University of Calgary.
local time = param("time", { default = 8, min = 0, max = 10, step = 0.125, doc = "Age of the leaf" })
local delay = param("delay", { default = 2, min = 1, max = 4, doc = "Age at which an apex branches" })
local growth =
  param("growth", { default = 1.5, min = 1, max = 2, doc = "Growth of internodes per unit of time" })
local STEP = 0.125

local Apex, Metamer, Internode =
  module("Apex", "age"), module("Metamer", "age"), module("Internode", "length")

local leaf = lsystem({ object = turtle({ angle = 45, width = 0.26 }), interpret = "last" })
leaf:axiom(Apex(0))
leaf:rule("Apex(age)", function(this, age: number)
  return Apex(age + STEP)
end)
leaf:rule("Internode(length)", function(this, length: number)
  return Internode(length * growth ^ STEP)
end)
leaf:decompose("Apex(age)", {
  when = function(this, age)
    return age >= delay
  end,
}, function(this, age)
  return Metamer(age - delay), Apex(age - 1)
end)
leaf:decompose("Metamer(age)", function(this, age)
  local half = Internode(growth ^ age / 2)
  return half, { Left(), Apex(age) }, { Right(), Apex(age) }, half
end)
leaf:interpret("Internode(length)", function(this, length)
  return Color("#5f7f35"), F(length)
end)
leaf:interpret("Apex(age)", function(this, age)
  return Color("#3fa34d"), F(age)
end)
local plant = leaf:derive(time / STEP)

-- At time 8 the axis has seven metamers of lengths 1.5^0 to 1.5^6, and an apex of age and length 1.
expect(plant.objects[1]:position().z, (1.5 ^ 7 - 1) / 0.5 + 1, 1e-6)
-- Picture: --azimuth 180 --elevation 0
