--!strict
-- Lychnis coronaria: the apex ends in a flower, and two lateral apices continue, one of them four steps ahead.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 3.14.
local age =
  param("age", { default = 30, min = 1, max = 45, step = 1, unit = "steps", doc = "Age of the plant" })
local petals = param("petals", { default = "#c2306e", doc = "Colour of the flowers" })

local Apex, Internode = module("Apex", "time"), module("Internode", "time")
local Leaf, Flower = module("Leaf", "age"), module("Flower", "age")

local plant =
  lsystem({ object = turtle({ step = 0.1, width = 0.16, color = "#6d9a58", sides = 6 }), interpret = "last" })
plant:axiom(Apex(7))
plant:rule("Apex(t)", function(this, t: number): any
  if t < 7 then
    return Apex(t + 1)
  end
  return F(),
    Internode(20),
    { Down(60), Leaf(0) },
    RollRight(90),
    { Down(45), Apex(0) },
    RollRight(90),
    { Down(60), Leaf(0) },
    RollRight(90),
    { Down(45), Apex(4) },
    F(),
    Internode(10),
    Flower(0)
end)
plant:rule("Internode(t)", function(this, t: number): any
  if t > 0 then
    return F(), F(), Internode(t - 1)
  end
  return Internode(t)
end)
plant:rule("Leaf(a)", "Leaf(a + 1)")
plant:rule("Flower(a)", "Flower(a + 1)")

plant:interpret("Leaf(a)", function(this, a: number)
  local length, width = 0.35 + a * 0.05, 0.12 + a * 0.012
  return Color("#5d8f4c"),
    BeginPolygon(),
    Point(),
    { G(length / 2), Left(90), G(width), Point() },
    { G(length), Point() },
    { G(length / 2), Right(90), G(width), Point() },
    EndPolygon()
end)
-- Five petals, which open in five steps.
plant:interpret("Flower(a)", function(this, a: number): any
  local open = math.min(a, 5)
  local size = 0.15 + 0.06 * open
  local parts: any = { Sphere(0.12), Color(petals) }
  for k = 1, 5 do
    for _, part in
      {
        BeginPolygon(),
        Point(),
        { RollRight(k * 72 - 25), Down(15 + 13 * open), G(size), Point() },
        { RollRight(k * 72 + 25), Down(15 + 13 * open), G(size), Point() },
        EndPolygon(),
      }
    do
      table.insert(parts, part)
    end
  end
  return table.unpack(parts)
end)

-- An apex waits seven steps, and one with a start of four waits three; both flower in the step after that: flowers appear
-- in step n as often as f(n) = f(n - 8) + f(n - 4) with f(1) = 1.
local appear: { number }, flowers = { 1 }, 1
for n = 2, 30 do
  appear[n] = (appear[n - 8] or 0) + (appear[n - 4] or 0)
  flowers += appear[n]
end
local counts = plant:derive(age).counts
expect({ counts.Flower, counts.Leaf, counts.Apex }, { flowers, 2 * flowers, flowers + 1 })

-- Picture: --azimuth 200 --elevation 12
