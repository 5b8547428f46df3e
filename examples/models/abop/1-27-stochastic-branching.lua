--!strict
-- Five plants from one stochastic system: a segment grows two branches, a left one or a right one.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.27.
local steps = param("steps", { default = 5, min = 1, max = 6, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 25.7, min = 5, max = 90, unit = "deg", doc = "Of the branches" })
local height = param("height", { default = 2, min = 0.1, max = 20, unit = "m", doc = "Length of the stems" })

local plants: any = {}
for k = 1, 5 do
  table.insert(plants, { id = `plant {k}`, x = k * height * 0.36 })
end

local field = lsystem({ object = turtle, interpret = "last" })
field:axiom(source(plants), function(plant)
  local pen = turtle({
    step = height / 3 ^ steps,
    angle = angle,
    width = height / 110,
    position = { plant.x, 0, 0 },
    color = "#47742f",
    sides = 4,
  })
  return pen, F()
end)
field:rule("F", { weight = 0.33 }, "F[+F]F[-F]F" :: any)
field:rule("F", { weight = 0.33 }, "F[+F]FF" :: any)
field:rule("F", { weight = 0.34 }, "FF[-F]F" :: any)

local derived = field:derive(steps)
-- Every successor has three segments on the axis, so each stem has its full length whatever was chosen.
for k, pen in derived.objects do
  expect(pen:position():distance(vec(k * 0.72, 0, 2)), 0, 1e-9)
end
-- A segment becomes five segments in one of three cases and four otherwise, so 5 plants have 5 * 4.33^5 on average.
expect(derived.counts.F, 5 * 4.33 ^ 5, 5 * 4.33 ^ 5 / 3)

-- Picture: --azimuth 180 --elevation 5
