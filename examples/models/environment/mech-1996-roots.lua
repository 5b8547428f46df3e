--!strict
-- Roots that seek water: a tip turns towards wet soil, branches where it finds much water, and ends in dry soil. Two springs
-- water a dry section of the ground, and the water spreads.
-- Source: R. Mech and P. Prusinkiewicz, Visual models of plants interacting with their environment, 1996.
local steps = param("steps", { default = 34, min = 1, max = 60, step = 1, doc = "Steps of the derivation" })
local need =
  param("need", { default = 0.25, min = 0, max = 1, doc = "Share of its need with which a tip grows" })

local size, cell = vec(4, 0.8, 3), 0.1
local ground = soil({ size = size, cell = cell, amount = 0.25, diffusion = 0.0004 })

local Section, Spring, Spent =
  module("Section"), module("Spring", "place", "radius", "amount"), module("Spent")
local Tip, Segment, Plant = module("Tip", "rank"), module("Segment", "way", "rank", "age"), module("Plant")
local Level = module("Level")
local budget = variables({ given = 0, taken = 0, left = 0 })
local roots = lsystem({
  object = turtle({ width = 0.02, sides = 6, color = "#e8d3a8" }),
  environment = ground,
  variables = budget,
})

roots:axiom(
  Section(),
  Plant(),
  Spring(vec(-1.1, 0, -1.3), 0.6, 3000),
  Spring(vec(1.2, 0, -2.3), 0.55, 2500),
  { Pitch(180), Tip(0) },
  { Pitch(125), Tip(1) },
  { Pitch(-125), Tip(1) },
  Level()
)

roots:ignore("Spent")

-- A spring flows before the first step only.
roots:rule("Spring", function()
  return nil
end)
roots:rule("Tip(rank)", function(this, rank: number)
  local place: Vector, heading: Vector = this:position(), this:heading()
  local share = ground:taken(place) / 0.4
  if share < need then
    return Spent()
  end
  local wet: Vector = ground:gradient(place, 0.6)
  local way = heading + wet * 0.35 + vec(random(-0.35, 0.35), random(-0.25, 0.25), random(-0.4, 0.25))
  if rank < 4 and share > 0.6 and random() < 0.22 then
    local side = if random() < 0.5 then 1.2 else -1.2
    local aside = heading:cross(vec(0, 1, 0)) * side
    return Segment(way, rank, 0), { Segment(way + aside, rank + 1, 0), Tip(rank + 1) }, Tip(rank)
  end
  return Segment(way, rank, 0), Tip(rank)
end)
roots:rule("Segment(way, rank, age)", function(_, way, rank, age: number)
  return Segment(way, rank, age + 1)
end)

roots:interpret("Spring(place, radius, amount)", function(_, place, radius, amount)
  budget.given += ground:add(place, radius, amount)
end)
roots:interpret("Tip(rank)", function(this)
  budget.taken += ground:take(this:position(), 0.15, 0.4)
end)
roots:interpret("Level", function()
  budget.left = ground:total()
end)
roots:interpret("Segment(way, rank, age)", function(this, way, rank, age)
  this:face(way):width(0.008 + 0.0022 * age * 0.65 ^ rank):color("#e8d3a8"):forward(0.1)
end)

-- The section behind the roots: the wetter, the darker.
roots:interpret("Section", function(this)
  local points, faces, colors = {}, {}, {}
  for x = -size.x / 2, size.x / 2 - cell / 2, cell do
    for z = -size.z, -cell / 2, cell do
      local first = #points
      for corner, at in { vec(0, 0, 0), vec(1, 0, 0), vec(1, 0, 1), vec(0, 0, 1) } do
        points[first + corner] = vec(x, size.y / 2, z) + at * cell
      end
      faces[#faces + 1] = { first + 1, first + 2, first + 3, first + 4 }
      local wet = math.min(1, ground:amount(vec(x + cell / 2, 0.05, z + cell / 2)) / 2.5)
      colors[#colors + 1] = mix("#a9855a", "#2f3a4c", math.floor(wet * 40) / 40)
    end
  end
  this:mesh(points, faces, { colors = colors })
end)
roots:interpret("Plant", function(this)
  this:color("#5d8f3a")
  for number = 1, 24 do
    local turn, lean = number * 2.4, 0.15 + 0.02 * number
    this:jump(vec(0, 0, 0)):face(vec(lean * math.sin(turn), lean * math.cos(turn), 1))
    for part = 0, 5 do
      local on = this:heading() + vec(math.sin(turn), math.cos(turn), -0.5) * 0.14
      this:width(0.035 - 0.005 * part):face(on):forward(0.13)
    end
  end
  this:jump(vec(0, 0, 0)):face(vec(0, 0, 1))
end)

local derived = roots:derive(steps)
-- No water is lost: the roots have what the ground and the springs gave.
local cells = size.x * size.y * size.z / cell ^ 3
local spent = derived.variables
expect(spent.given, 5500)
expect(spent.left + spent.taken, 0.25 * cells + spent.given, 1e-6)
expect(spent.taken > 500, true)
-- Some tips have ended in dry soil, and others still grow.
expect(derived.counts.Spent > 10 and derived.counts.Tip > 20, true)

-- Picture: --azimuth 180 --elevation 2
