--!strict
-- Plants that compete for ground: circles grow, and of two that overlap the weaker one dies, so the stand thins out
-- while its plants become larger. A hook finds the plants that die, and groups of rules take turns: growth, then
-- thinning.
-- Source: O. Deussen et al., Realistic modeling and rendering of plant ecosystems, 1998, section 4.
local plants =
  param("plants", { default = 600, min = 1, max = 2000, step = 1, doc = "Plants at the beginning" })
local side = param("side", { default = 30, min = 5, max = 80, unit = "m", doc = "Side of the field" })
local years = param("years", { default = 12, min = 0, max = 40, step = 1, doc = "Years of growth" })

-- Two species: fast and small, or slow and large.
local SPECIES = {
  { growth = 0.22, full = 1.1, model = "round", color = "#7f9f3f" },
  { growth = 0.16, full = 2.2, model = "tall", color = "#3f6f4a" },
}

local Plant = module("Plant", "number", "x", "y", "radius", "species")

local field = variables({ dead = {} :: { [string]: boolean }, alive = plants, overlaps = 0 })

-- Crowns with a radius of 1 m.
local Crown = module("Crown", "kind", "color")
local function crown(kind: string, color: string): Derived
  local system = lsystem({ object = extruder({ sides = 10, color = "#6f5a40" }) })
  system:axiom(Crown(kind, color))
  system:interpret("Crown(kind, color)", function(this)
    this:scale(0.12):extrude(0.6):color(color)
    if kind == "tall" then
      this:scale(1):taper(0.05):extrude(3)
    else
      this:scale(0.7):extrude(0.15):scale(1):extrude(0.5):scale(0.7):extrude(0.4):taper(0.2):extrude(0.25)
    end
  end)
  return system:derive()
end
local crowns: { Derived } = {}
for k, species in SPECIES do
  crowns[k] = crown(species.model, species.color)
end

type Circle = { number: number, x: number, y: number, radius: number }

-- Pairs of plants whose circles overlap, the weaker one first.
local function overlapping(): { { Circle } }
  local all: { Circle } = {}
  for k, row in query("select number, x, y, radius from Plant order by radius, number") do
    all[k] = { number = row.number, x = row.x, y = row.y, radius = row.radius }
  end
  local pairs_found: { { Circle } } = {}
  for k, weak in all do
    for other = k + 1, #all do
      local strong = all[other]
      if (weak.x - strong.x) ^ 2 + (weak.y - strong.y) ^ 2 < (weak.radius + strong.radius) ^ 2 then
        table.insert(pairs_found, { weak, strong })
        break
      end
    end
  end
  return pairs_found
end

local stand = lsystem({ object = turtle(), variables = field, interpret = "last" })
local seeds: { any } = {}
local draw = stream("seeds")
for number = 1, plants do
  local species = if draw() < 0.5 then 1 else 2
  table.insert(seeds, { Plant(number, draw(0, side), draw(0, side), draw(0.02, 0.2), species) })
end
stand:axiom(sequence(seeds))
stand:before_step(function(now)
  if now.step % 2 == 1 then
    return use_group("grow")
  end
  local dead: { [string]: boolean } = {}
  for _, circles in overlapping() do
    dead[tostring(circles[1].number)] = true
  end
  field.dead = dead
  return use_group("thin")
end)
stand:rule(
  "Plant(number, x, y, radius, species)",
  { group = "grow" },
  function(this, number, x, y, radius, species)
    local kind = SPECIES[species]
    return Plant(number, x, y, radius + kind.growth * (1 - radius / kind.full), species)
  end
)
stand:rule("Plant(number, x, y, radius, species)", {
  group = "thin",
  when = function(this, number)
    return field.dead[tostring(number)] == true
  end,
}, function()
  return nil
end)
stand:at_end(function(now)
  field.alive, field.overlaps = now.counts.Plant, #overlapping()
end)
stand:interpret("Plant(number, x, y, radius, species)", function(this, number, x, y, radius, species)
  this:jump({ x, y, 0 }):place(crowns[species], radius)
end)
local result = stand:derive(2 * years)

-- After thinning, no two plants overlap, and less than half of the plants are left.
expect(result.variables.overlaps, 0)
expect(result.variables.alive, result.counts.Plant)
expect(result.counts.Plant < 600 / 2, true)
-- Picture: --azimuth 200 --elevation 35
