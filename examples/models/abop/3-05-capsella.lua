--!strict
-- Shepherd's purse: the apex makes leaves, then flowers without end. Petals fall after six steps, and a pod follows.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 3.5.
local age =
  param("age", { default = 32, min = 1, max = 60, step = 1, unit = "steps", doc = "Age of the plant" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "Of the organs" })

local Vegetative, Flowering = module("Vegetative", "time"), module("Flowering")
local Internode, Bend = module("Internode", "time"), module("Bend", "time")
local Leaf, Flower = module("Leaf", "age"), module("Flower", "age")

local plant = lsystem({ object = turtle({ width = 1.6, color = "#5d8a44", sides = 6 }), interpret = "last" })
plant:axiom(Internode(9), Vegetative(13))
plant:rule("Vegetative(t)", function(this, t: number)
  return { Down(70), Leaf(0) },
    RollRight(divergence),
    Internode(10),
    if t > 0 then Vegetative(t - 1) else Flowering()
end)
plant:rule("Flowering", function()
  return { Down(18), Bend(4), Width(0.9), F(1), F(1), Internode(10), Internode(5), Flower(0) },
    RollRight(divergence),
    Internode(8),
    Flowering()
end)
-- An internode makes a segment in each step, and a stalk bends by nine degrees.
plant:rule("Internode(t)", function(this, t: number): any
  if t > 0 then
    return F(1), Internode(t - 1)
  end
  return F(1)
end)
plant:rule("Bend(t)", function(this, t: number): any
  if t > 0 then
    return Down(9), Bend(t - 1)
  end
  return Down(9)
end)
plant:rule("Leaf(a)", "Leaf(math.min(a + 1, 8))")
plant:rule("Flower(a)", "Flower(a + 1)")

-- A shape symmetrical to the heading: distances along it and to its sides.
local function shape(outline: { { number } }, size: number): any
  local parts: any = { BeginPolygon() }
  for k = 1, 2 * #outline do
    local side = if k <= #outline then -90 else 90
    local at = outline[if k <= #outline then k else 2 * #outline + 1 - k]
    table.insert(parts, { G(at[1] * size), Turn(side), G(at[2] * size), Point() })
  end
  table.insert(parts, EndPolygon())
  return table.unpack(parts)
end
plant:interpret("Leaf(a)", function(this, a: number): any
  return Color("#4f8038"), shape({ { 0, 0.1 }, { 1, 0.9 }, { 2, 0.95 }, { 3, 0.1 } }, 2 * a + 1)
end)
plant:interpret("Flower(a)", function(this, a: number): any
  if a > 6 then
    return Color("#8fae4a"),
      Up(50),
      shape({ { 0, 0.1 }, { 3, 1.6 }, { 3.4, 1 }, { 3, 0.1 } }, math.min(a / 4, 4))
  end
  local parts: any = { Color("#f4f2ea") }
  for k = 1, 4 do
    table.insert(
      parts,
      { RollRight(k * 90), Down(40), shape({ { 0, 0.1 }, { 1, 0.5 }, { 1.6, 0.3 } }, 1.5 + a / 2) }
    )
  end
  return table.unpack(parts)
end)

local derived = plant:derive(age)
-- A leaf in each of the first 14 steps, and a flower in each later one.
expect({ derived.counts.Leaf, derived.counts.Flower }, { 14, 32 - 14 })
-- An internode has a segment more in each step, up to its time and one.
local stem = 10
for n = 1, 32 do
  stem += math.min(32 - n, if n <= 14 then 11 else 9)
end
expect(derived.objects[1]:position().z, stem, 1e-9)

-- Picture: --elevation 8
