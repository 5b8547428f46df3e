--!strict
-- The Thue-Morse word as a curve: one symbol goes forward, the other turns by 60 degrees. It approaches the Koch curve.
-- Source: J. Ma and J. Holdener, When Thue-Morse meets Koch, 2005.
local steps =
  param("steps", { default = 10, min = 0, max = 14, step = 1, doc = "Steps; the word has 2^n symbols" })
local color = param("color", { default = "#2f5f8f", doc = "Colour of the curve" })

local Forward, Bend = module("Forward"), module("Bend")

local curve = lsystem({
  object = turtle({ heading = { 1, 0, 0 }, width = 0.35, color = color, sides = 6 }),
  interpret = "last",
})
curve:axiom(Forward())
curve:rule("Forward", function()
  return Forward(), Bend()
end)
curve:rule("Bend", function()
  return Bend(), Forward()
end)
curve:interpret("Forward", function()
  return F(1)
end)
curve:interpret("Bend", function()
  return Turn(60)
end)
local result = curve:derive(steps)

-- Each symbol becomes one of each kind, so both are equally frequent.
expect(result.counts, { Forward = 512, Bend = 512 })
-- Picture: --azimuth 180 --elevation 0
