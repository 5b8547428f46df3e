--!strict
-- A plant that creeps on a curved surface: it grows in the two parameters of the surface, and is drawn on it.
-- Source: L-Py, tutorial/12 - curved-space/turtle_on_patch, F. Boudon and C. Godin.
local steps = param("steps", { default = 22, min = 0, max = 40, step = 1, doc = "Steps of growth" })
local length =
  param("length", { default = 0.035, min = 0.01, max = 0.2, doc = "Of a segment, in parameters" })
local curl =
  param("curl", { default = 9, min = -30, max = 30, unit = "deg", doc = "Turn of a stem in a step" })

-- The height is x y, which cubic pieces describe exactly.
local rows: { { Vector } } = {}
for j = 0, 3 do
  rows[j + 1] = {}
  for i = 0, 3 do
    local x, y = 4 * i / 3 - 2, 4 * j / 3 - 2
    rows[j + 1][i + 1] = vec(x, y, 0.35 * x * y)
  end
end
local patch = surface(rows, { kind = "bezier", divisions = 24 })

local Ground = module("Ground")
local Tip, Stem = module("Tip", "u", "v", "heading", "age"), module("Stem", "u", "v", "to_u", "to_v", "age")
local Leaf = module("Leaf", "u", "v", "heading")

local ivy = lsystem({ object = turtle({ sides = 6 }), interpret = "last" })
ivy:axiom({ Ground() }, Tip(0.5, 0.03, 80, 0))
ivy:rule("Tip(u, v, heading, age)", {
  when = function(this, u, v, heading, age)
    local to_u, to_v = u + length * math.cos(math.rad(heading)), v + length * math.sin(math.rad(heading))
    return math.min(to_u, to_v) > 0.02 and math.max(to_u, to_v) < 0.98
  end,
}, function(this, u, v, heading, age): any
  local to_u, to_v = u + length * math.cos(math.rad(heading)), v + length * math.sin(math.rad(heading))
  local stem, leaf = Stem(u, v, to_u, to_v, 0), Leaf(to_u, to_v, heading + (if age % 2 == 0 then 60 else -60))
  -- Every fourth node of a stem branches, with the other direction of turning.
  if age % 4 == 3 then
    return stem, { Tip(to_u, to_v, heading - 48, age + 1) }, { Tip(to_u, to_v, heading + 35, age + 2) }
  end
  local side = if age % 8 < 4 then curl else -curl
  return stem, { leaf }, Tip(to_u, to_v, heading + side, age + 1)
end)
ivy:rule(
  "Stem(u, v, to_u, to_v, age)",
  function(this, u: number, v: number, to_u: number, to_v: number, age: number)
    return Stem(u, v, to_u, to_v, age + 1)
  end
)
ivy:interpret("Ground", function(this)
  this:color("#c9bfae"):surface(patch, 1)
end)
ivy:interpret("Stem(u, v, to_u, to_v, age)", function(this, u, v, to_u, to_v, age)
  local from, to = patch:point(u, v), patch:point(to_u, to_v)
  this:jump(from):face(to - from):color("#6f5a3a"):width(0.02 + 0.004 * age):forward((to - from):length())
end)
ivy:interpret("Leaf(u, v, heading)", function(this, u, v, heading)
  local a = math.rad(heading)
  local place, normal = patch:point(u, v), patch:normal(u, v)
  local ahead =
    patch:point(math.clamp(u + 0.01 * math.cos(a), 0, 1), math.clamp(v + 0.01 * math.sin(a), 0, 1))
  local along = (ahead - place):unit()
  local side = normal:cross(along) * 0.08
  local lift = normal * 0.03
  this:color("#4f8f45"):begin_polygon()
  for _, corner in { lift * 0.3, along * 0.12 - side + lift, along * 0.28 + lift, along * 0.12 + side + lift } do
    this:jump(place + corner):point()
  end
  this:end_polygon()
end)
local result = ivy:derive(steps)

-- All nodes are on the surface, whose height is 0.35 x y.
for node in string.gmatch(result.chains[1], "Leaf%(([^)]+)%)") do
  local numbers = string.split(node, ",")
  local place = patch:point(tonumber(numbers[1]) :: number, tonumber(numbers[2]) :: number)
  expect(place.z, 0.35 * place.x * place.y, 1e-9)
end
expect(result.counts.Leaf, 180)
-- Picture: --azimuth 215 --elevation 60
