--!strict
-- Ivy on a ruined portal. The script derives the portal first. The rules of the vine then query the distance of a
-- position to it: a shoot that is too near turns away, a shoot that strays turns back, and a shoot out of reach
-- withers.
local days =
  param("days", { default = 72, min = 1, max = 140, step = 1, unit = "days", doc = "Steps of growth" })
local shoots =
  param("shoots", { default = 4, min = 1, max = 8, step = 1, doc = "Shoots at the foot of each pillar" })
local stride = param("stride", { default = 0.11, min = 0.05, max = 0.2, unit = "m", doc = "Growth in a day" })
local branching =
  param("branching", { default = 0.055, min = 0, max = 0.4, doc = "Chance of a branch in a day" })
local stone = param("stone", { default = "#c9b79a", doc = "Colour of the portal" })

-- The portal: two pillars and the rest of an arch.
local Pillar = module("Pillar", "height")
local Arch = module("Arch", "angle")
local Beside = module("Beside", "x")
local portal = lsystem({ object = extruder({ color = stone, smooth = false, roughness = 0.95 }) })

portal:axiom({ Beside(-1.5), Pillar(3.2), Arch(118) }, { Beside(1.5), Pillar(2.3) })
portal:interpret("Beside(x)", function(this, x)
  this:shift(x, 0)
end)
portal:interpret("Pillar(h)", function(this, h)
  this:rectangle(0.9, 0.9):extrude(0.25)
  this:rectangle(0.78, 0.78):extrude(0.12)
  this:regular(8):scale(0.34):taper(0.3):extrude(h)
  this:rectangle(1, 1):scale(0.62):taper(0.82):extrude(0.16)
  this:rectangle(0.82, 0.82):scale(1):extrude(0.12)
end)
portal:interpret("Arch(angle)", function(this, angle)
  this:rectangle(0.6, 0.56):bend(angle, 180):resolution(12, 0):extrude(1.5 * math.rad(angle))
end)
local ruin = portal:derive()

local function clearance(place: any): number
  return ruin.objects[1]:distance(place)
end

-- The direction in which the distance grows fastest.
local function away(place)
  local here, small = clearance(place), 0.02
  return vec(
    clearance(place + vec(small, 0, 0)) - here,
    clearance(place + vec(0, small, 0)) - here,
    clearance(place + vec(0, 0, small)) - here
  ):unit()
end

-- An ivy leaf with five lobes.
local leaf = {}
for _, tint in { "#2f5d2c", "#3f7a35", "#6a9a45" } do
  local system = lsystem({ object = turtle({ color = tint, roughness = 0.5 }) })
  local function half(side: number)
    return {
      Roll(side * 14),
      BeginPolygon(),
      Point(),
      { Turn(side * 115), G(0.4), Point() },
      { Turn(side * 70), G(0.36), Point() },
      { Turn(side * 48), G(0.72), Point() },
      { Turn(side * 24), G(0.56), Point() },
      { G(1.05), Point() },
      EndPolygon(),
    }
  end
  system:axiom(half(1), half(-1))
  table.insert(leaf, system:derive())
end

local NEAR, FAR, LOST = 0.03, 0.07, 0.3 -- distances from the stone (m)

local Start = module("Start", "place")
local Tip = module("Tip", "place", "heading")
local Stem = module("Stem", "place", "way", "width")
local Leaf = module("Leaf", "place", "out", "size", "tint")

local vine = lsystem({ object = turtle({ color = "#5b4a33", sides = 6 }), interpret = "last" })

local seedlings = {}
for side = -1, 1, 2 do
  for k = 1, shoots do
    local angle = math.rad(k * 360 / shoots + 20)
    local out = vec(math.cos(angle), math.sin(angle), 0)
    local place = vec(side * 1.5, 0, 0.1) + out * 0.72
    table.insert(seedlings, { Start(place), Tip(place, vec(0, 0, 1)) })
  end
end
vine:axiom(table.unpack(seedlings))

-- A shoot grows a piece of stem with a leaf, winds slightly upwards, and sometimes branches.
local function grow(place, heading: any, bend)
  local upwards = if place.z < 0.2 then 1 else random(-0.15, 0.6)
  local wander = vec(random(-0.5, 0.5), random(-0.5, 0.5), upwards)
  local way = (heading + bend + wander * 0.5):unit() * stride
  local next = place + way
  local out = away(next)
  local parts = {
    Stem(place, way, 0.008),
    { Leaf(next, out, random(0.07, 0.14), random(0, 3)) },
    Tip(next, way / stride),
  }
  if random() < branching then
    local aside = way:cross(out):unit() * (if random() < 0.5 then -1 else 1)
    table.insert(parts, 3, { Tip(next, aside) })
  end
  return table.unpack(parts)
end

-- A shoot without support ends; a shoot near the stone turns away, and a shoot far from it turns back.
vine:rule("Tip(p, h)", {
  when = function(this, p, h)
    return clearance(p + h * stride) > LOST
  end,
}, function()
  return nil
end)
vine:rule("Tip(p, h)", {
  when = function(this, p, h)
    return clearance(p + h * stride) < NEAR
  end,
}, function(this, p, h)
  return grow(p, h, away(p) * 0.9)
end)
vine:rule("Tip(p, h)", {
  when = function(this, p, h)
    return clearance(p + h * stride) > FAR
  end,
}, function(this, p, h)
  return grow(p, h, away(p) * -0.7)
end)
vine:rule("Tip(p, h)", function(this, p, h)
  return grow(p, h, vec(0, 0, 0))
end)

-- Stems thicken with age.
vine:rule("Stem(p, way, w)", function(this, p, way, w: number)
  return Stem(p, way, math.min(w + 0.0006, 0.06))
end)

vine:interpret("Start(p)", function(this, p)
  this:jump(p)
end)
vine:interpret("Stem(p, way, w)", function(this, p, way, w)
  this:width(w)
  this:face(way)
  this:forward(stride)
end)
vine:interpret("Leaf(p, out, size, tint)", function(this, p, out, size, tint)
  this:face(out + vec(0, 0, if p.z < 0.3 then 0.4 else -0.6))
  this:place(leaf[math.floor(tint) + 1], size)
end)

vine:derive(days)
