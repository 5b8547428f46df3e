--!strict
-- Sympodial growth in continuous time: an apex becomes a flower when it is due, and two lateral apices continue.
-- Source: Virtual Laboratory (cpfg), Mod-vis-3D/10-sympodial, University of Calgary.
local time = param("time", { default = 8, min = 0, max = 10, doc = "Age of the plant (plastochrons)" })
local duration = param("duration", { default = 8, min = 1, max = 20, doc = "Time in which organs grow" })
local angle = param("angle", { default = 25, min = 5, max = 60, unit = "deg", doc = "Branching angle" })

local Apex, Internode, Flower = module("Apex", "age"), module("Internode", "age"), module("Flower", "age")

local function grown(age: number): number
  return ease.smooth(math.clamp(age / duration, 0, 1))
end

local plant = lsystem({ object = turtle({ width = 0.03, color = "#5f7f35" }), interpret = "last" })
plant:axiom(RollLeft(60), Apex(time))
plant:decompose("Apex(age)", {
  when = function(this, age)
    return age > 1
  end,
}, function(this, age)
  local young = age - 1
  return Internode(young),
    Roll(90),
    { Left(angle), Apex(young) },
    { Right(angle), Apex(young) },
    Flower(young)
end)
plant:interpret("Internode(age)", function(this, age)
  return F(grown(age))
end)
plant:interpret("Flower(age)", function(this, age)
  return F(0.4 * grown(age)), Color("#d05a8f"), Sphere(0.02 + 0.07 * grown(age))
end)
local result = plant:derive(0)

-- The age 8 is seven plastochrons more than that of the last apices, which have not branched.
expect(result.counts.Apex, 2 ^ 7)
expect(result.counts.Flower, 2 ^ 7 - 1)
expect(result.counts.Internode, 2 ^ 7 - 1)
-- Picture: --azimuth 180 --elevation 10
