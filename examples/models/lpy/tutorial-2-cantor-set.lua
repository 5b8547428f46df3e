--!strict
-- The Cantor set: each segment loses its middle third. The picture shows all stages, from top to bottom.
-- Source: L-Py, tutorial/02 - fractals/cantorset, F. Boudon and C. Godin.
local stages = param("stages", { default = 5, min = 0, max = 7, step = 1, doc = "Number of stages" })

-- Each stage is a system of its own.
local function stage(n: number): any
  local height = (stages - n) * 0.09
  local bars = lsystem({
    object = turtle({ position = { 0, 0, height }, heading = { 1, 0, 0 }, width = 0.05, color = "#4763b0" }),
    interpret = "last",
  })
  bars:axiom(F(1))
  bars:rule("F(x)", function(this, x: number)
    return F(x / 3), G(x / 3), F(x / 3)
  end)
  return bars:derive(n)
end

-- The stage n has 2^n segments, and its gaps were made by 1 + 2 + ... + 2^(n - 1) steps; the whole is 1 m long.
for n = 0, stages do
  local bars = stage(n)
  expect(bars.counts, { F = 2 ^ n, G = if n == 0 then nil else 2 ^ n - 1 })
  expect(bars.objects[1]:position().x, 1, 1e-12)
end
-- Picture: --azimuth 180 --elevation 0
