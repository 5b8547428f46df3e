--!strict
-- Apical dominance: the auxin of the apex keeps buds dormant. It flows down to the base, and a bud grows out when the
-- level next to it is low.
-- Source: L-Py, training/14-apical-dominance, F. Boudon and C. Godin.
local steps = param("steps", { default = 300, min = 0, max = 600, step = 1, doc = "Steps of growth" })
local level = param("level", { default = 10, min = 1, max = 20, doc = "Auxin at a growing apex" })
local threshold = param("threshold", { default = 5, min = 0, max = 10, doc = "Auxin at which buds grow out" })
local speed = param("speed", { default = 0.33, min = 0.01, max = 0.33, doc = "Part that flows in a step" })
local INTERNODES, ORDERS = 8, 4 -- internodes of the main axis; highest order of branches

local Root, Internode = module("Root"), module("Internode", "auxin")
local Apex, Bud, Flower = module("Apex", "left", "order"), module("Bud", "order"), module("Flower")

local plant = lsystem({ object = turtle({ width = 0.8 }), interpret = "last" })
plant:ignore("Turn")
plant:axiom(Root(), Apex(INTERNODES, 0))

plant:rule("Apex(left, order)", function(this, left, order)
  if left < 1 then
    return Internode(level), Flower()
  end
  local angle = (20 + 70 * left / (INTERNODES * (order + 1))) * (if left % 2 == 0 then 1 else -1)
  return Internode(level), { Turn(angle), Bud(order + 1) }, Apex(left - 1, order)
end)
plant:rule("Internode(a) < Bud(order)", function(this, a, order)
  if order >= ORDERS then
    return nil
  end
  return if a <= threshold then Apex(INTERNODES / 2 ^ order, order) else Bud(order)
end)

-- The apex keeps its internode full; all other internodes exchange auxin with their neighbours, and the root drains it.
plant:rule("Internode(a) > Apex", function()
  return Internode(level)
end)
plant:rule("Internode(n) < Internode(a) > Flower", function(this, n: number, a: number)
  return Internode(a + (n - a) * speed)
end)
plant:rule(
  "Internode(n) < Internode(a) > [Internode(k)] Internode(q)",
  function(this, n: number, a: number, k: number, q: number)
    return Internode(a + (n + k + q - 3 * a) * speed)
  end
)
plant:rule("Internode(n) < Internode(a) > Internode(q)", function(this, n: number, a: number, q: number)
  return Internode(a + (n + q - 2 * a) * speed)
end)
plant:rule(
  "Root < Internode(a) > [Internode(k)] Internode(q)",
  function(this, a: number, k: number, q: number)
    return Internode(a + (k + q - 3 * a) * speed)
  end
)
plant:rule("Root < Internode(a) > Internode(q)", function(this, a: number, q: number)
  return Internode(a + (q - 2 * a) * speed)
end)

plant:interpret("Internode(a)", function(this, a)
  return Color(mix("#d8b04a", "#4f8f3c", math.clamp(a / level, 0, 1))), F(10)
end)
plant:interpret("Apex", function()
  return Color("#4f8f3c"), F(2), Sphere(1)
end)
plant:interpret("Bud", function()
  return Color("#8a5a2f"), F(1), Sphere(0.8)
end)
plant:interpret("Flower", function()
  return Color("#d8402f"), Sphere(1.6)
end)
local result = plant:derive(steps)

-- The main axis stops after eight buds and a last internode. It has the flower of the main axis and of each branch
-- that is complete; a branch of the order n has 8 / 2^n + 1 internodes.
expect(result.counts.Flower >= 1, true)
expect(result.objects[1]:position().z, 9 * 10, 1e-9)
-- Picture: --azimuth 180 --elevation 0
