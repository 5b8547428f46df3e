--!strict
-- A plant with leaves and flowers, in which the apex, the internodes and the organs are modules of their own.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.26.
local steps = param("steps", { default = 5, min = 1, max = 6, step = 1, doc = "Steps of the derivation" })
local angle = param("angle", { default = 18, min = 5, max = 40, unit = "deg", doc = "Of all turns" })
local petals = param("petals", { default = "#d9509a", doc = "Colour of the petals" })

local Apex, Internode, Segment = module("Apex"), module("Internode"), module("Segment")
local Leaf, Flower, Petal = module("Leaf"), module("Flower"), module("Petal")

local plant = lsystem({
  object = turtle({ angle = angle, width = 0.35, color = "#4c7a34", sides = 5 }),
  interpret = "last",
})
plant:axiom(Apex())
plant:rule("Apex", function()
  return Internode(),
    Left(),
    { Apex(), Left(), Flower() },
    Right(2 * angle),
    RollRight(2 * angle),
    { Right(2 * angle), Leaf() },
    Internode(),
    { Left(2 * angle), Leaf() },
    Right(),
    { Apex(), Flower() },
    Left(2 * angle),
    Apex(),
    Flower()
end)
plant:rule("Internode", function()
  return F(),
    Segment(),
    { RollRight(2 * angle), Down(2 * angle), Leaf() },
    { RollRight(2 * angle), Up(2 * angle), Leaf() },
    F(),
    Segment()
end)
plant:rule("Segment", "Segment F Segment")

-- Leaves and petals are polygons with edges of 1 m, and a flower has five petals on a stalk.
plant:interpret("Leaf", function(this): any
  this:color("#5f9c3f")
  local tip = { G(), Point(), Right(), G(), Point(), G(), Point(), Right(), G(), Point() }
  local parts: any = { BeginPolygon(), Left() }
  for side = 1, 2 do
    for _, part in tip do
      table.insert(parts, part)
    end
    table.insert(parts, Left())
    table.insert(parts, TurnAround())
    table.insert(parts, Left())
  end
  table.insert(parts, EndPolygon())
  return table.unpack(parts)
end)
plant:interpret("Flower", function(): any
  local parts: any = { Down(3 * angle), Width(0.2), F(2) }
  for k = 1, 5 do
    table.insert(parts, { RollRight(k * 72), Petal() })
  end
  return table.unpack(parts)
end)
plant:interpret("Petal", function(this)
  this:pitch(4 * angle):color(petals)
  return BeginPolygon(),
    Point(),
    { Right(), G(1.1), Point() },
    { G(2), Point() },
    { Left(), G(1.1), Point() },
    EndPolygon()
end)

-- Three apices and three flowers replace an apex: 3^n apices, and 3 (3^n - 1) / 2 flowers.
-- An apex makes two leaves and two internodes, which make two leaves each in the next step.
local counts = plant:derive(steps).counts
expect({ counts.Apex, counts.Flower }, { 3 ^ 5, 3 * (3 ^ 5 - 1) / 2 })
expect(counts.Leaf, (3 ^ 5 - 1) + 2 * (3 ^ 4 - 1))
