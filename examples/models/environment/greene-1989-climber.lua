--!strict
-- Vines that climb a gate: each tip tries several ways on, keeps to the surface and away from other vines, and never grows
-- into the stone.
-- Source: N. Greene, Voxel space automata: modeling with stochastic growth processes in voxel space, 1989.
local steps = param("steps", { default = 40, min = 1, max = 60, step = 1, doc = "Steps of the derivation" })
local reach = param(
  "reach",
  { default = 0.1, min = 0.03, max = 0.4, unit = "m", doc = "Maximum distance from the stone" }
)

local gap, stride = 0.03, 0.12

-- The gate: two pillars, a lintel, and a ball on each pillar.
local Block, Ball = module("Block", "low", "size"), module("Ball", "place", "radius")
local gate = lsystem({ object = extruder({ sides = 4, smooth = false, color = "#b5a793" }) })
gate:axiom(
  Block(vec(-1.2, 0, 0), vec(0.8, 0.8, 0.25)),
  Block(vec(1.2, 0, 0), vec(0.8, 0.8, 0.25)),
  Block(vec(-1.2, 0, 0), vec(0.6, 0.6, 2.2)),
  Block(vec(1.2, 0, 0), vec(0.6, 0.6, 2.2)),
  Block(vec(0, 0, 2.2), vec(3.4, 0.7, 0.35))
)
gate:interpret("Block(low, size)", function(this, low, size)
  this:jump(low):rectangle(size.x, size.y):extrude(size.z)
end)
local balls = lsystem({ object = turtle({ sides = 32, color = "#b5a793" }) })
balls:axiom(Ball(vec(-1.2, 0, 2.85), 0.36), Ball(vec(1.2, 0, 2.85), 0.36))
balls:interpret("Ball(place, radius)", function(this, place, radius)
  this:jump(place):sphere(radius)
end)
local blocks, spheres = gate:derive(0), balls:derive(0)
local stone = obstacles():mesh(blocks):mesh(spheres)
local site = lsystem({ object = turtle() })
site:axiom(Place(blocks), Place(spheres))
site:derive(0)

-- Light of a voxel falls with the number of shoots in it.
local density = shadow_voxels({ size = 0.2, depth = 1, decay = 0, strength = 0.25 })
local Tip, Shoot, Leaf =
  module("Tip", "way", "rank"), module("Shoot", "to", "age"), module("Leaf", "size", "turn")
local Start, End = module("Start", "place"), module("End")
local inside = variables({ count = 0 })
local vines = lsystem({
  object = turtle({ width = 0.02, sides = 5, color = "#6a5238" }),
  environment = { stone, density },
  variables = inside,
})

vines:axiom(source({ -1, -0.8, 1.1, 1.35 }), function(x)
  return Start(vec(x, -0.5, 0)), Tip(vec(0, 0.4, 0.9), 0)
end)

vines:ignore("End")

-- Returns the best of several places to grow to, or nil if all are in the stone, too far from it, or crowded.
local function best_place(place: Vector, way: Vector): Vector?
  local best, score = nil, -math.huge
  for _ = 1, 14 do
    local to = way:unit() + vec(random(-1, 1), random(-1, 1), random(-0.7, 1.1)) * 0.8
    local next = place + to:unit() * stride
    next = next + stone:normal(next) * (gap - stone:distance(next)) * 0.7
    local away = stone:distance(next)
    local room = density:light(next)
    local is_free = next.z > 0
      and away > gap / 2
      and stone:hit(place, next) == nil
      and next:distance(place) > stride / 3
    if is_free and (away < reach or place.z < 0.3) and room > 0.3 then
      local value = room + 0.25 * next.z - 3 * away + random(0, 0.5)
      if value > score then
        best, score = next, value
      end
    end
  end
  return best
end

vines:rule("Tip(way, rank)", function(this, way, rank: number)
  local place = this:position()
  local to = best_place(place, way)
  if not to then
    return End()
  end
  local on = to - place
  local leaf = Leaf(random(0.05, 0.08), random(0, 360))
  if rank < 4 and random() < 0.17 then
    local aside = on:cross(stone:normal(place)) * (random() < 0.5 and 1 or -1)
    return Shoot(on, 0), leaf, { Tip(on + aside, rank + 1) }, Tip(on, rank)
  end
  return Shoot(on, 0), leaf, Tip(on, rank)
end)
vines:rule("Shoot(to, age)", function(_, to, age: number)
  return Shoot(to, age + 1)
end)

vines:interpret("Start(place)", function(this, place)
  this:jump(place)
end)
vines:interpret("Shoot(to, age)", function(this, to, age)
  density:shade(this:position())
  this:face(to):width(0.012 + 0.0011 * age):color("#6a5238"):forward(to:length())
  inside.count += if stone:contains(this:position()) then 1 else 0
end)
vines:interpret("Leaf(size, turn)", function(this, size, turn)
  local green = mix("#3c6b2c", "#86ad4a", random() // 0.125 / 8)
  this:face(stone:normal(this:position()) + vec(0, 0, 0.35)):roll(turn):color(green)
  local points = {}
  for corner = 0, 9 do
    local angle = math.rad(corner * 36)
    local span = size * (if corner % 2 == 0 then 1.15 else 0.75) * (1 + 0.35 * math.cos(angle))
    points[corner + 1] = vec(span * math.cos(angle), span * math.sin(angle), 0.04)
  end
  this:mesh(points, { { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 } })
end)

local derived = vines:derive(steps)
-- Each shoot has a leaf, no shoot is in the stone, and crowding has ended more tips than are left.
expect(derived.counts.Leaf, derived.counts.Shoot)
expect(derived.variables.count, 0)
expect(derived.counts.Shoot > 800 and derived.counts.Shoot < 4000, true)
expect(derived.counts.End > (derived.counts.Tip or 0), true)

-- Picture: --azimuth 205 --elevation 10
