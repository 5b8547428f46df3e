--!strict
-- A fountain: each step releases particles, which follow gravity and bounce on the ground with a part of their speed.
-- Source: L-Py, tutorial/08 - various/particles, F. Boudon and C. Godin.
local steps = param("steps", { default = 45, min = 0, max = 200, step = 1, doc = "Steps" })
local jets =
  param("jets", { default = 12, min = 1, max = 40, step = 1, doc = "Particles released in a step" })
local interval =
  param("interval", { default = 0.025, min = 0.005, max = 0.1, unit = "s", doc = "Time of a step" })
local bounce =
  param("bounce", { default = 0.6, min = 0, max = 1, doc = "Part of the speed that a bounce keeps" })
local GRAVITY, SPEED, SPREAD = 9.81, 5, 1 -- m/s^2; m/s upwards and outwards

local Source, Particle = module("Source"), module("Particle", "place", "speed", "age")

local fountain = lsystem({ object = turtle({ sides = 8 }), interpret = "last" })
fountain:axiom(Source())
fountain:rule("Source", function()
  local parts: any = {}
  for k = 1, jets do
    local angle = 2 * math.pi * (k / jets + step() * 0.382)
    local speed = vec(SPREAD * math.cos(angle), SPREAD * math.sin(angle), SPEED)
    table.insert(parts, Particle(vec(0, 0, 0), speed, 0))
  end
  return Source(), table.unpack(parts)
end)
fountain:rule("Particle(place, speed, age)", function(this, place: any, speed: any, age: number)
  local faster = speed - vec(0, 0, GRAVITY * interval)
  local next = place + faster * interval
  if next.z < 0 then
    return Particle(vec(next.x, next.y, -next.z), vec(faster.x, faster.y, -faster.z) * bounce, age + 1)
  end
  return Particle(next, faster, age + 1)
end)
fountain:interpret("Source", function()
  return { Color("#8a8a90"), Width(0.3), F(0.02) }
end)
fountain:interpret("Particle(place, speed, age)", function(this, place: any, speed: any, age: number)
  this:jump(place):color(mix("#3f8fd0", "#dfeaf5", age / steps)):sphere(0.045)
end)
local result = fountain:derive(steps)

-- All particles of 44 steps and of the last one. A particle is n steps of t at n t (v - g t (n + 1) / 2), which is the
-- highest at n = v / (g t) - 1/2 = 20 steps, at 1.21 m.
expect(result.counts.Particle, 45 * 12)
local highest = 0
for z in result.chains[1]:gmatch("Particle%(vec{x=[%d.e-]+,y=[%d.e-]+,z=([%d.e-]+)}") do
  highest = math.max(highest, tonumber(z) :: number)
end
expect(highest, 20 * 0.025 * (5 - 9.81 * 0.025 * 21 / 2), 0.01)
