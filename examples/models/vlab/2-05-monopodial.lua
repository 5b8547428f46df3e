--!strict
-- Monopodial growth in continuous time: the apex creates metamers, whose parts unfold along functions of their age.
-- Source: Virtual Laboratory (cpfg), Mod-vis-3D/05-monopodial, University of Calgary.
local time = param("time", { default = 20, min = 0, max = 40, doc = "Age of the plant" })
local plastochron =
  param("plastochron", { default = 0.5, min = 0.2, max = 2, doc = "Time from metamer to metamer" })
local duration = param("duration", { default = 20, min = 1, max = 40, doc = "Time in which organs grow" })

local Apex, Internode, Leaf = module("Apex", "age"), module("Internode", "age"), module("Leaf", "age")

local function grown(age: number): number
  return ease.smooth(math.clamp(age / duration, 0, 1))
end

local plant = lsystem({ object = turtle({ width = 0.1, color = "#5f7f35" }), interpret = "last" })
plant:axiom(Apex(time))
plant:decompose("Apex(age)", {
  when = function(this, age)
    return age > plastochron
  end,
}, function(this, age)
  local young = age - plastochron
  return Internode(young), { Left(45), Leaf(young) }, { Right(45), Leaf(young) }, Apex(young)
end)
plant:interpret("Internode(age)", function(this, age)
  return F(0.5 * grown(age))
end)
plant:interpret("Leaf(age)", function(this, age)
  return Color("#4fa34d"), F(1.5 * grown(age))
end)
local result = plant:derive(0)

-- A metamer each 0.5 until the apex is at most 0.5 old. Smooth growth is symmetrical, grown(a) + grown(20 - a) = 1, so
-- the ages 0.5 to 19.5 have the mean 1/2: the stem is 39 * 0.5 / 2 high.
expect(result.counts, { Apex = 1, Internode = 39, Leaf = 78, Left = 39, Right = 39 })
expect(result.objects[1]:position().z, 39 / 4, 1e-9)
-- Picture: --azimuth 180 --elevation 0
