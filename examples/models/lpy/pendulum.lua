--!strict
-- A pendulum as an L-system of one module: each step changes the speed and then the angle. A second module keeps its trace.
-- Source: L-Py, tutorial/08 - various/pendulum, F. Boudon and C. Godin.
local steps = param("steps", { default = 20, min = 0, max = 400, step = 1, doc = "Steps" })
local start = param("start", { default = 60, min = 1, max = 179, unit = "deg", doc = "Angle at the start" })
local interval =
  param("interval", { default = 0.05, min = 0.01, max = 0.2, unit = "s", doc = "Time of a step" })
local GRAVITY, LENGTH = 9.81, 1

local Bob, Trace = module("Bob", "angle", "speed"), module("Trace", "angle", "age")

local pendulum = lsystem({ object = turtle({ heading = { 0, 0, -1 }, width = 0.02 }), interpret = "last" })
pendulum:axiom(Bob(start, 0))
pendulum:rule("Bob(angle, speed)", function(this, angle: number, speed: number)
  local next = speed - math.deg(GRAVITY / LENGTH * math.sin(math.rad(angle))) * interval
  return Bob(angle + next * interval, next), Trace(angle, 0)
end)
pendulum:rule("Trace(angle, age)", function(this, angle: number, age: number)
  return Trace(angle, age + 1)
end)
pendulum:interpret("Bob(angle, speed)", function(this, angle)
  return { Turn(angle), Color("#8a8a90"), F(LENGTH), Color("#c0392b"), Sphere(0.07) }
end)
pendulum:interpret("Trace(angle, age)", function(this, angle, age)
  return { Turn(angle), G(LENGTH), Color(mix("#d8703f", "#cfd3d8", age / steps)), Sphere(0.03) }
end)
local result = pendulum:derive(steps)

-- From 60 degrees, a swing takes 2 pi sqrt(l / g) (1 + 1/16 * (pi / 3)^2 + ...) = 2.153 s, so the bob has crossed the
-- lowest place and is near the other side after 20 steps of 0.05 s.
local angle = tonumber(result.chains[1]:match("^Bob%((-?[%d.]+)")) :: number
expect(angle, 60 * math.cos(2 * math.pi * 1 / 2.153), 4)
-- Picture: --azimuth 180 --elevation 0
