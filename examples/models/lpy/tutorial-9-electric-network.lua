--!strict
-- The flow of sap as an electric current: resistances are added up towards the base, and then the current is divided
-- from the base to the tips. The first half of the steps computes resistances, the second half currents.
-- Source: L-Py, tutorial/09 - carbon/electricnetwork, F. Boudon and C. Godin.
local orders = param("orders", { default = 5, min = 0, max = 7, step = 1, doc = "Orders of branches" })
local potential =
  param("potential", { default = 1, min = 0.1, max = 10, unit = "MPa", doc = "Between base and leaves" })
local WIDE, NARROW = 0.4, 0.6 -- parts of the conductance in the wide and the narrow branch

local Apex = module("Apex", "order", "resistance")
local Wood = module("Wood", "resistance", "total", "current") -- total includes everything that it carries

local tree = lsystem({ object = turtle({ sides = 8 }), interpret = "last" })
tree:consider("Wood")
tree:axiom(Apex(0, 1))
tree:decompose("Apex(order, r)", function(this, order, r): any
  if order > orders then
    return nil
  end
  return Wood(r, r, 0),
    Roll(90),
    { Turn(35), Apex(order + 1, r / NARROW) },
    { Turn(-35), Apex(order + 1, r / WIDE) }
end)

local function is_upwards(): boolean
  return step() > orders
end
local function is_downwards(): boolean
  return step() <= orders
end
tree:rule(
  "Wood(r, total, i) > [Wood(r1, a, i1)] [Wood(r2, b, i2)]",
  { when = is_downwards },
  function(this, r, total, i, r1, a, i1, r2, b)
    return Wood(r, r + 1 / (1 / a + 1 / b), 0)
  end
)
-- The current of a branch is the share of its parent's current by conductance, which comes from the potential.
tree:rule("Wood(r0, t0, i0) < Wood(r, total, i)", { when = is_upwards }, function(this, r0, t0, i0, r, total)
  return Wood(r, total, i0 * (t0 - r0) / total)
end)
tree:rule("Wood(r, total, i)", { when = is_upwards }, function(this, r, total)
  return Wood(r, total, potential / total)
end)
tree:interpret("Wood(r, total, i)", function(this, r, total, current)
  local share = current * total / potential
  return Color(mix("#d8b04a", "#3f6fb0", share)), Width(0.3 * r ^ -0.25), F(1.6 * r ^ -0.08)
end)
local result = tree:derive(2 * orders + 1)

-- Two branches in parallel have the resistances r / 0.6 and r / 0.4, together r: each order adds 1 to the base. The
-- current 1/6 of the base is divided as the resistances say, so all tips together get it again.
expect(result.chains[1]:match("^Wood%(1,(%d+)"), "6")
local sum = 0
for current in result.chains[1]:gmatch("Wood%([%d.]+,[%d.]+,([%d.e-]+)%)") do
  sum += tonumber(current) :: number
end
expect(sum, 6 * (1 / 6), 1e-3)
