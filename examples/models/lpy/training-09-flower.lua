--!strict
-- A raceme in continuous growth: leaves below, then buds that open, flower and become fruits, in spiral phyllotaxis. Every
-- part grows by the same rate.
-- Source: L-Py, training/09-flower-continous-growth, F. Boudon and C. Godin.
local leaf_pairs = param("leaf_pairs", { default = 5, min = 0, max = 10, step = 1, doc = "Pairs of leaves" })
local buds =
  param("buds", { default = 20, min = 0, max = 60, step = 1, unit = "steps", doc = "Time as a bud" })
local flowers =
  param("flowers", { default = 40, min = 0, max = 60, step = 1, unit = "steps", doc = "Time as a flower" })
local fruits =
  param("fruits", { default = 25, min = 0, max = 60, step = 1, unit = "steps", doc = "Time as a fruit" })
local growth =
  param("growth", { default = 1.01, min = 1, max = 1.03, doc = "Growth of internodes in a step" })

local Apex, Internode = module("Apex", "age"), module("Internode", "length")
local Leaf, Bud = module("Leaf", "age"), module("Bud", "age")
local Flower, Fruit = module("Flower", "age"), module("Fruit", "age")

local plant = lsystem({ object = turtle({ color = "#6f8f4a", width = 50, sides = 6 }), interpret = "last" })
plant:axiom(Internode(150), Apex(0))
plant:rule("Apex(age)", function(this, age: number)
  if age < leaf_pairs then
    return { Leaf(0) }, { Roll(180), Leaf(0) }, Roll(95), Internode(120), Apex(age + 1)
  end
  return { Bud(0) }, Roll(137.5), Internode(26), Apex(age + 1)
end)
plant:rule("Internode(length)", function(this, length: number)
  return Internode(length * growth)
end)
plant:rule("Leaf(age)", function(this, age: number)
  return Leaf(age + 1)
end)
plant:rule("Bud(age)", function(this, age: number)
  return if age + 1 < buds then Bud(age + 1) else Flower(0)
end)
plant:rule("Flower(age)", function(this, age: number)
  return if age + 1 < flowers then Flower(age + 1) else Fruit(0)
end)
plant:rule("Fruit(age)", function(this, age: number)
  return Fruit(age + 1)
end)

local function blade(length: number, angle: number): any
  return {
    BeginPolygon(),
    Point(),
    { Turn(angle), G(length * 0.6), Point() },
    { G(length), Point() },
    { Turn(-angle), G(length * 0.6), Point() },
    EndPolygon(),
  }
end
plant:interpret("Internode(length)", function(this, length: number)
  return F(length)
end)
plant:interpret("Leaf(age)", function(this, age: number)
  return Color("#4f8f3c"), Pitch(math.min(age, 9) * 7), blade(1300, 16)
end)
-- A stalk as long as its age says, which bends down.
local function stalk(age: number): (any, any, any)
  return Pitch(math.min(20 + age, 110)), Width(16), F(170 * growth ^ age)
end
plant:interpret("Bud(age)", function(this, age: number)
  local bend, width, line = stalk(age)
  return bend, width, line, Sphere(25 + 2 * age)
end)
plant:interpret("Flower(age)", function(this, age: number)
  local bend, width, line = stalk(buds + age)
  local petals: any = { bend, width, line, Color("#c85a9a") }
  for k = 1, 5 do
    table.insert(petals, { Roll(k * 72), Pitch(15 + age / 2), blade(300, 26) })
  end
  return table.unpack(petals)
end)
plant:interpret("Fruit(age)", function(this, age: number)
  local bend, width, line = stalk(buds + flowers + age)
  return bend, width, line, Color("#a8542f"), Sphere(70)
end)
local result = plant:derive(leaf_pairs + buds + flowers + fruits)

-- After the leaves, a bud appears in each step. The stages last 20 and 40 steps, so there are as many buds and flowers,
-- and 25 fruits.
expect(result.counts.Leaf, 2 * 5)
expect(result.counts.Bud, 20)
expect(result.counts.Flower, 40)
expect(result.counts.Fruit, 25)
