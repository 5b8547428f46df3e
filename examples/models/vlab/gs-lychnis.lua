--!strict
-- Lychnis coronaria: an apex becomes a flower, and two branches continue it after different delays. All organs follow from
-- their age, so any stage of development is one derivation.
-- Source: Virtual Laboratory (cpfg), GettingStarted/Lychnis, University of Calgary, after P. Prusinkiewicz, A. Lindenmayer
-- and J. Hanan, Developmental models of herbaceous plants for computer imagery purposes, 1988.
local age = param("age", { default = 28, min = 0, max = 36, doc = "Age of the plant (days)" })
local early = param("early", { default = 4, min = 2, max = 10, doc = "Delay of the first branch (days)" })
local late = param("late", { default = 7, min = 2, max = 10, doc = "Delay of the second branch (days)" })
local angle =
  param("angle", { default = 40, min = 10, max = 70, unit = "deg", doc = "Angle of a grown branch" })
local tropism = param("tropism", { default = 0.05, min = -0.2, max = 0.2, doc = "Tilt upwards of a segment" })

local Apex, Internode, Stalk = module("Apex", "age"), module("Internode", "age"), module("Stalk", "age")
local Fork, Leaf, Flower = module("Fork", "side", "age"), module("Leaf", "age"), module("Flower", "age")

local function grown(days: number, duration: number): number
  return ease.smooth(math.clamp(days / duration, 0, 1))
end

-- An axis has 15 segments, and the simple tropism tilts it upwards after each of them.
local function axis(pen: Turtle, width: number, length: number)
  pen:width(width)
  for _ = 1, 15 do
    pen:forward(length / 15)
  end
end

local plant = lsystem({
  object = turtle({ color = "#6f8f4a", sides = 6, simple_tropism = { 0, 0, 1 }, simple_elasticity = tropism }),
  interpret = "last",
})
plant:axiom(Roll(45), Pitch(5), Apex(age))
plant:decompose("Apex(t)", {
  when = function(this, t)
    return t > 0
  end,
}, function(this, t)
  return Internode(t),
    { Stalk(t), Flower(t) },
    Roll(90),
    { Fork(1, t), { Roll(90), Leaf(t) }, Apex(t - early) },
    { Fork(-1, t), { Roll(-90), Leaf(t) }, Apex(t - late) }
end)
plant:interpret("Internode(t)", function(this, t)
  axis(this, 0.25 + 0.012 * t, 8 * grown(t, 20))
end)
plant:interpret("Stalk(t)", function(this, t)
  axis(this, 0.22, 5 * grown(t, 10))
end)
plant:interpret("Fork(side, t)", function(this, side, t)
  return Turn(side * angle * grown(t, 30))
end)
plant:interpret("Leaf(t)", function(this, t)
  local size = 3 * grown(t, 20)
  return Color("#7fa05f"),
    SimpleElasticity(0),
    Pitch(60),
    BeginPolygon(),
    Point(),
    { Turn(20), G(size), Point() },
    { G(2 * size), Point() },
    { Turn(-20), G(size), Point() },
    EndPolygon()
end)
-- A bud until day 1, a flower until day 6, then a fruit.
plant:interpret("Flower(t)", function(this, t): any
  if t < 1 or t > 6 then
    return Color(if t < 1 then "#8fae6a" else "#8a6a3f"), Sphere(0.35 + 0.35 * grown(t, 17))
  end
  local petals: any = { Color("#c8286f"), SimpleElasticity(0) }
  for k = 1, 5 do
    table.insert(petals, {
      Roll(k * 72),
      Pitch(70),
      BeginPolygon(),
      Point(),
      { Turn(35), G(2), Point() },
      { Turn(-35), G(2), Point() },
      EndPolygon(),
    })
  end
  return table.unpack(petals)
end)
local result = plant:derive(0)

-- The number of flowers satisfies f(t) = 1 + f(t - 4) + f(t - 7), with f = 0 before the first day.
local function flowers(t: number): number
  return if t <= 0 then 0 else 1 + flowers(t - 4) + flowers(t - 7)
end
expect(result.counts.Flower, flowers(28))
expect(result.counts.Apex, flowers(28) + 1)
-- Picture: --elevation 40
