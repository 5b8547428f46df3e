--!strict
-- A monopodial shoot with spiral phyllotaxis: internodes and leaves unfold along functions of their age.
-- Source: Virtual Laboratory (cpfg), Mod-vis-3D/09-monopodial-spiral, University of Calgary.
local time = param("time", { default = 22.5, min = 0, max = 40, doc = "Age of the shoot" })
local plastochron =
  param("plastochron", { default = 0.5, min = 0.2, max = 2, doc = "Time from leaf to leaf" })
local phyllotaxis =
  param("phyllotaxis", { default = 137.5, min = 90, max = 180, unit = "deg", doc = "From leaf to leaf" })

local Apex, Internode, Leaf = module("Apex", "age"), module("Internode", "age"), module("Leaf", "age")

local function grown(age: number, duration: number): number
  return ease.smooth(math.clamp(age / duration, 0, 1))
end

local shoot = lsystem({ object = turtle({ width = 0.2, color = "#6f8f4a" }), interpret = "last" })
shoot:axiom(Apex(time))
shoot:decompose("Apex(t)", {
  when = function(this, t)
    return t > plastochron
  end,
}, function(this, t)
  local young = t - plastochron
  return Internode(young), { Leaf(young) }, Roll(phyllotaxis), Apex(young)
end)
shoot:interpret("Internode(t)", function(this, t)
  return F(0.5 * grown(t, 15))
end)
-- A blade of eight corners with its widest place in the middle, folded along the rib.
local function half(side: number, length: number, width: number)
  return {
    Roll(15 * side),
    BeginPolygon(),
    Point(),
    { G(length * 0.25), Turn(90 * side), G(width * 0.8), Point() },
    { G(length * 0.5), Turn(90 * side), G(width), Point() },
    { G(length * 0.8), Turn(90 * side), G(width * 0.5), Point() },
    { G(length), Point() },
    EndPolygon(),
  }
end
shoot:interpret("Leaf(t)", function(this, t)
  local length, width = 2.6 * grown(t, 10), 0.6 * grown(t, 20)
  return Pitch(90 * grown(t, 30)),
    Color(mix("#a8cf5a", "#3f7f35", grown(t, 22))),
    half(1, length, width),
    half(-1, length, width)
end)
local result = shoot:derive(0)

-- Leaves are 22, 21.5, ... 0.5 old. Half of the 29 internodes below 15 have grown, on average; the 15 older ones have.
expect(result.counts.Leaf, 44)
expect(result.objects[1]:position().z, 0.5 * (29 / 2 + 15), 1e-9)
-- Picture: --azimuth 150 --elevation 15
