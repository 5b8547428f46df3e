--!strict
-- A tree of life: each lineage splits into two at a constant rate, and dies out at another. Branches are as long as
-- lineages live; those that are alive today end in leaves, extinct ones in grey knots.
-- Source: D. G. Kendall, On the generalized birth-and-death process, 1948; without extinction, G. U. Yule, A mathematical
-- theory of evolution, 1925.
local splits = param("splits", { default = 0.5, min = 0.1, max = 1, doc = "Births (1 / million years)" })
local dies = param("dies", { default = 0.15, min = 0, max = 1, doc = "Extinctions (1 / million years)" })
local today =
  param("today", { default = 9, min = 1, max = 12, unit = "million years", doc = "Time of the picture" })

local Lineage, Extinct = module("Lineage", "born"), module("Extinct")

local life = lsystem({ object = turtle({ sides = 12, width = 0.07, color = "#6d5340" }) })
life:axiom(Lineage(0))
life:rule("Lineage(born)", { propensity = splits }, function(this, born)
  local angle = random(14, 30)
  local left = { Turn(angle), Roll(random(60, 120)), Lineage(time()) }
  return F(time() - born), left, { Turn(-angle), Roll(random(60, 120)), Lineage(time()) }
end)
life:rule("Lineage(born)", { propensity = dies }, function(this, born): any
  return F(time() - born), Extinct()
end)
life:interpret("Lineage(born)", function(this, born: number)
  this:forward(time() - born):color("#7fa650"):sphere(0.16)
end)
life:interpret("Extinct", function(this)
  this:color("#9a968f"):sphere(0.1)
end)
life:derive({ time = today })

-- After the time t, e^((splits - dies) t) lineages are alive on average. The variance of their number is known, too.
local trials, alive, t = 300, 0, 4
for trial = 1, trials do
  local one = lsystem({ seed = trial })
  one:axiom(Lineage(0))
  one:rule("Lineage", { propensity = 0.5 }, function()
    return Lineage(0), Lineage(0)
  end)
  one:rule("Lineage", { propensity = 0.15 }, function(): any
    return Extinct()
  end)
  alive += one:derive({ time = t }).counts.Lineage
end
local mean = math.exp(0.35 * t)
local variance = mean * (mean - 1) * (0.5 + 0.15) / (0.5 - 0.15)
expect(alive / trials, mean, 3 * math.sqrt(variance / trials))
