--!strict
-- A field of plants that spread by seeds, grow, and die under the larger crowns of their neighbours: self-thinning.
-- Source: O. Deussen et al., Realistic modeling and rendering of plant ecosystems, 1998, section 4.2.
local steps = param("steps", { default = 26, min = 1, max = 40, step = 1, doc = "Steps of the derivation" })
local side = param("side", { default = 24, min = 5, max = 60, unit = "m", doc = "Side of the field" })

local crowns = discs()
local Plant = module("Plant", "x", "y", "radius")
local field = lsystem({ object = turtle({ width = 0.1, sides = 12 }), environment = crowns })

field:axiom(Plant(-4, -3, 0.4), Plant(5, 2, 0.4), Plant(-2, 6, 0.4))

field:rule("Plant(x, y, radius)", function(_, x: number, y: number, radius: number)
  if crowns:dominated(vec(x, y, 0)) then
    return nil
  end
  local grown = Plant(x, y, radius + (1.6 - radius) * 0.12)
  local seed = vec(x + random(-5, 5), y + random(-5, 5), 0)
  local inside = math.max(math.abs(seed.x), math.abs(seed.y)) < side / 2
  if inside and random() < 0.6 then
    return grown, Plant(seed.x, seed.y, 0.15)
  end
  return grown
end)

field:interpret("Plant(x, y, radius)", function(this, x, y, radius)
  crowns:add(vec(x, y, 0), radius)
  local shade = radius / 1.6
  this:jump(vec(x, y, 0)):width(0.05 + 0.12 * radius):color("#5b4130"):forward(radius * 1.4)
  this:color(if shade > 0.75 then "#3f6b34" elseif shade > 0.4 then "#5d8f3a" else "#a3b950"):sphere(radius)
end)

local derived = field:derive(steps)
-- The crowns fill the field, and competition limits their number.
expect(derived.counts.Plant > 60, true)
expect(derived.counts.Plant < 400, true)

-- Picture: --azimuth 30 --elevation 40
