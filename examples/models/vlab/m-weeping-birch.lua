--!strict
-- A weeping birch: an internode that carries n internodes gives them to two branches, in random proportion.
-- Source: Virtual Laboratory (cpfg), CPFG manual, WeepingBirch, University of Calgary.
local total = param("total", { default = 1500, min = 1, max = 20000, step = 1, doc = "Number of internodes" })
local spread =
  param("spread", { default = 30, min = 5, max = 60, unit = "deg", doc = "Angle between two branches" })
local weeping =
  param("weeping", { default = 0.06, min = 0.01, max = 0.08, doc = "Loss of elasticity at each branching" })

local Branch, Leaf = module("Branch", "carried"), module("Leaf")

-- The fifth smallest of 20 uniform numbers has the beta distribution with the parameters 5 and 16.
local function share(): number
  local numbers = {}
  for k = 1, 20 do
    numbers[k] = random()
  end
  table.sort(numbers)
  return numbers[5]
end

-- The elasticity falls from 0.4 at the ground: limbs rise, and twigs, whose elasticity is below 0, hang.
local pen = turtle({
  color = "#cfc8ba",
  sides = 5,
  simple_tropism = { -0.04, 0, 1 },
  simple_elasticity = 0.4,
  simple_increment = -weeping,
})
local birch = lsystem({ object = pen, interpret = "last" })
birch:axiom(Width(0.4 * total ^ 0.3), Branch(total))
birch:rule("Branch(n)", function(this, n): any
  if n < 1 then
    return nil
  elseif n == 1 then
    return Color("#8a7a4a"), Width(0.2), F(2), Leaf()
  end
  local left = math.floor(n * share())
  local right = n - 1 - left
  return Width(0.4 * n ^ 0.3),
    SimpleElasticity(),
    F(n ^ 0.4),
    Roll(180),
    { Turn(spread * right / n), Branch(left) },
    { Turn(-spread * left / n), Branch(right) }
end)
birch:interpret("Leaf", function(this)
  local blade = { Turn(30), G(2), Point(), Turn(-30), G(2), Point(), Turn(-30), G(2), Point() }
  return Color(mix("#5f8f22", "#b8a02a", random())),
    SimpleElasticity(0),
    BeginPolygon(),
    Point(),
    { table.unpack(blade) },
    EndPolygon()
end)
local tree = birch:derive()

-- An internode that carries n - 1 others counts as one: there are as many internodes as the first one has to carry.
expect(tree.counts.F, 1500)
