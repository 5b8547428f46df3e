--!strict
-- Compound leaves with alternating branches: a branch is to the left and the next one to the right.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 5.12.
local height = param("height", { default = 2, min = 0.1, max = 10, unit = "m", doc = "Length of each leaf" })

-- The book makes 20, 34 and 46 steps, with details too small to see here.
local LEAVES = {
  { delay = 1, rate = 1.36, steps = 15 },
  { delay = 4, rate = 1.18, steps = 26 },
  { delay = 7, rate = 1.13, steps = 36 },
}

local Apex = module("Apex", "delay", "side")

for k, leaf in LEAVES do
  -- Two internodes are made in each step and grow in all later ones: 2 (1 + r + r^2 + ...).
  local length = 2 * (leaf.rate ^ leaf.steps - 1) / (leaf.rate - 1)
  local place = vec(k * height * 0.66, 0, 0)
  local system = lsystem({
    object = turtle({ width = height / 120, position = place, color = "#47742f", sides = 3 }),
    interpret = "last",
  })
  system:axiom(Apex(0, 1))
  system:rule("Apex(d, side)", function(this, d: number, side: number): any
    if d > 0 then
      return Apex(d - 1, side)
    end
    return F(1), { Turn(side * 45), Apex(leaf.delay, side) }, F(1), Apex(0, -side)
  end)
  system:rule("F(a)", function(this, a: number)
    return F(a * leaf.rate)
  end)
  system:interpret("F(a)", function(this, a)
    this:forward(a * height / length)
  end)

  local derived = system:derive(leaf.steps)
  expect(derived.objects[1]:position():distance(place), 2, 1e-9)
  -- Growing apices: a(n) = a(n - 1) + a(n - 1 - delay). Each makes two internodes in the next step.
  local active: { [number]: number }, branches = { [0] = 1 }, 1
  for n = 1, leaf.steps - 1 do
    active[n] = active[n - 1] + (active[n - 1 - leaf.delay] or 0)
    branches += active[n]
  end
  expect(derived.counts.F, 2 * branches)
end

-- Picture: --azimuth 180 --elevation 0
