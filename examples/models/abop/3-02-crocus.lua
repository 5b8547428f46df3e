--!strict
-- A crocus: the apex makes seven leaves, then a stalk with a flower. Leaves grow for nine steps and the flower for five.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 3.2.
local age =
  param("age", { default = 16, min = 1, max = 30, step = 1, unit = "steps", doc = "Age of the plant" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "Of the leaves" })
local petals = param("petals", { default = "#7a5bc0", doc = "Colour of the flower" })
local LEAVES, LEAF_AGE, FLOWER_AGE = 7, 9, 5

local Vegetative, Flowering = module("Vegetative", "time"), module("Flowering")
local Internode, Leaf, Flower = module("Internode", "length"), module("Leaf", "age"), module("Flower", "age")

local crocus = lsystem({ object = turtle({ width = 0.35, color = "#cfd9a0" }), interpret = "last" })
crocus:axiom(Vegetative(1))
crocus:rule("Vegetative(t)", function(this, t: number): any
  if t == LEAVES then
    return Internode(20), Flowering()
  end
  return Internode(1), { Down(30), Leaf(0) }, RollRight(divergence), Vegetative(t + 1)
end)
crocus:rule("Flowering", "Flower(0)")
crocus:rule("Leaf(t)", function(this, t: number)
  return Leaf(math.min(t + 1, LEAF_AGE))
end)
crocus:rule("Flower(t)", function(this, t: number)
  return Flower(math.min(t + 1, FLOWER_AGE))
end)
crocus:rule("Internode(l)", function(this, l: number)
  return Internode(if l < 2 then math.min(l + 0.2, 2) else l)
end)

crocus:interpret("Internode(l)", function(this, l: number)
  this:forward(l * 0.5)
end)
-- Narrow leaves in five pieces, which bend outwards.
local function blade(length: number, width: number, bend: number, color: any): any
  local parts: any = { Color(color) }
  for k = 0, 4 do
    local near, far =
      width * math.sin(math.pi * (0.15 + k * 0.17)), width * math.sin(math.pi * (0.32 + k * 0.17))
    for _, part in
      {
        BeginPolygon(),
        { Left(90), G(near), Point() },
        { Right(90), G(near), Point() },
        Down(bend / 5),
        G(length / 5),
        { Right(90), G(far), Point() },
        { Left(90), G(far), Point() },
        EndPolygon(),
      }
    do
      table.insert(parts, part)
    end
  end
  return table.unpack(parts)
end
crocus:interpret("Leaf(t)", function(this, t: number): any
  return Up(20), blade(3 + t * 1.2, 0.12 + t * 0.03, 45, "#4a8038")
end)
crocus:interpret("Flower(t)", function(this, t: number): any
  local parts: any = {}
  for k = 1, 6 do
    table.insert(
      parts,
      { RollRight(k * 60), Down(14 + t * 4), blade(2 + t * 0.5, 0.5 + t * 0.16, -30, petals) }
    )
  end
  return Color("#e6a12c"), Width(0.3), { F(2.2) }, table.unpack(parts)
end)

-- Six leaves, since the seventh step makes the stalk; it is in flower two steps later.
local derived = crocus:derive(age)
expect({ derived.counts.Leaf, derived.counts.Flower, derived.counts.Internode }, { 6, 1, 7 })
-- Internodes of 1 grow by 0.2 to 2, and the stalk keeps its length.
expect(derived.objects[1]:position().z, 0.5 * (6 * 2 + 20), 1e-9)

-- Picture: --azimuth 170 --elevation 12
