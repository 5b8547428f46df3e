--!strict
-- Control of branching by a flux: it rises from the base and is divided at each fork by the numbers of terminals, which
-- the branches report down. A terminal that gets more than a threshold forks.
-- Source: R. Borchert and H. Honda, Control of development in the bifurcating branch system of Tabebuia rosea: a computer
-- simulation, 1984; as an L-system in the Virtual Laboratory (cpfg), Quantitative-info-flow/03-Borchert-Honda.
local steps = param("steps", { default = 80, min = 0, max = 120, step = 1, doc = "Steps" })
local main =
  param("main", { default = 0.7, min = 0.5, max = 0.95, doc = "Part of the flux in the main branch" })
local threshold =
  param("threshold", { default = 5, min = 1, max = 20, doc = "Flux at which a terminal forks" })
local source_flux = param("flux", { default = 17, min = 5, max = 40, doc = "Flux of the first cycle" })
local ETA = 0.89 -- slows the growth of the flux: its cycle k is 2^((k - 1) eta^k) times the first one
local REST, RISING, REPORTING = 0, 1, 2

local Clock = module("Clock", "cycle")
local Apex = module("Apex", "side")
-- order: 0 at the base, 1 in main branches, 2 in lateral branches; terminals that the internode supports
local Internode = module("Internode", "order", "message", "flux", "terminals")

local tree = lsystem({ object = turtle({ sides = 8 }), interpret = "last" })
tree:ignore("Turn")
tree:axiom(Clock(1), Internode(0, REPORTING, 0, 1), Apex(1))

-- The base counts a cycle when the reports have arrived, and sends the next flux up.
tree:rule("Clock(k) > Internode(o, m, v, c)", {
  when = function(this, k, o, m)
    return m == REPORTING
  end,
}, function(this, k)
  return Clock(k + 1)
end)
tree:rule("Clock(k) < Internode(o, m, v, c)", {
  when = function(this, k, o, m)
    return m == REPORTING
  end,
}, function(this, k, o, m, v, c)
  return Internode(o, RISING, source_flux * 2 ^ ((k - 1) * ETA ^ k), c)
end)

-- A terminal forks or, if its flux is too small, reports.
tree:rule("Internode(o, m, v, c) < Apex(side)", {
  when = function(this, o, m, v)
    return m == RISING and v > threshold
  end,
}, function(this, o, m, v, c, side)
  return { Turn(-32 * side), Internode(2, REPORTING, v * (1 - main), 1), Apex(side) },
    Turn(10 * side),
    Internode(1, REPORTING, v * main, 1),
    Apex(-side)
end)
tree:rule("Internode(o, m, v, c) > Apex(side)", {
  when = function(this, o, m, v)
    return m == RISING and v <= threshold
  end,
}, function(this, o, m, v, c)
  return Internode(o, REPORTING, v, c)
end)

-- The flux rises. A lateral branch with n terminals next to a main one with m gets (1 - main) n / m of it.
tree:rule("Internode(p, q, w, d) < Internode(o, m, v, c)", {
  when = function(this, p, q)
    return q == RISING
  end,
}, function(this, p, q, w, d, o, m, v, c)
  local lateral = if o == 1 then w * (1 - main) * (d - c) / c else w * (1 - main) * c / (d - c)
  return Internode(o, RISING, if o == 1 then w - lateral else lateral, c)
end)

-- The reports of both branches are added up.
tree:rule("Internode(o, m, v, c) > [Internode(o2, m2, v2, c2)] Internode(o1, m1, v1, c1)", {
  when = function(this, o, m, v, c, o2, m2, v2, c2, o1, m1)
    return m == REST and m1 == REPORTING and m2 == REPORTING
  end,
}, function(this, o, m, v, c, o2, m2, v2, c2, o1, m1, v1, c1)
  return Internode(o, REPORTING, v, c1 + c2)
end)
tree:rule("Internode(o, m, v, c)", {
  when = function(this, o, m)
    return m == RISING
  end,
}, function(this, o, m, v, c)
  return Internode(o, REST, v, c)
end)
tree:rule("Internode(p, q, w, d) < Internode(o, m, v, c)", {
  when = function(this, p, q, w, d, o, m)
    return q == REPORTING and m == REPORTING
  end,
}, function(this, p, q, w, d, o, m, v, c)
  return Internode(o, REST, v, c)
end)

tree:interpret("Internode(o, m, v, c)", function(this, o, m, v, c)
  local color = if m == RISING then "#d8402f" elseif m == REPORTING then "#3f6fb0" else "#7a5a3a"
  return Color(color), Width((0.02 * c) ^ 0.7 + 0.06), F(1)
end)
tree:interpret("Apex", function()
  return Color("#5f9a3f"), Sphere(0.16)
end)
local result = tree:derive(steps)

-- In step 80, the report of the eighth cycle arrives at the base: it counts all terminals. Each of them comes from a
-- fork, which adds two internodes. The flux of the cycle is 17 * 2^(7 * 0.89^8).
local flux, terminals = result.chains[1]:match("Internode%(0,2,([%d.]+),(%d+)%)")
expect(tonumber(terminals), result.counts.Apex)
expect(result.counts.Internode, 2 * result.counts.Apex - 1)
expect(tonumber(flux), 17 * 2 ^ (7 * 0.89 ^ 8), 1e-6)
-- Picture: --azimuth 180 --elevation 0
