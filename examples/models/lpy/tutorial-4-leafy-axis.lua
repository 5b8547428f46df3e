--!strict
-- A leafy axis with distichous leaves, which are longer at the base; interpretations build each leaf from its rib.
-- Source: L-Py, tutorial/04 - simple-plant-archi/04 - leafyaxis, F. Boudon and C. Godin.
local leaves = param("leaves", { default = 10, min = 0, max = 20, step = 1, doc = "Number of leaves" })
local phyllotaxis =
  param("phyllotaxis", { default = 180, min = 0, max = 180, unit = "deg", doc = "From leaf to leaf" })
local arch = param("arch", { default = 110, min = 0, max = 200, unit = "deg", doc = "Bending of a leaf" })
local PIECES = 8

local Apex, Leaf, Rib = module("Apex", "n"), module("Leaf", "length"), module("Rib", "piece", "length")

local plant = lsystem({ object = turtle({ width = 0.25, color = "#7a9a4a", sides = 8 }), interpret = "last" })
plant:axiom(F(1), Apex(0))
plant:rule("Apex(n)", function(this, n: number)
  return { Up(30), Leaf(5 - n / 4) }, F(1), Roll(phyllotaxis), Apex(n + 1)
end)
plant:interpret("Leaf(length)", function(this, length)
  return Color("#4f8f35"), Rib(0, length)
end)

-- A piece of a blade: a quadrangle across the rib, as wide as the leaf is there.
local function breadth(piece: number, length: number): number
  return length * 0.12 * math.sin(math.pi * (0.12 + 0.88 * piece / PIECES))
end
plant:interpret("Rib(piece, length)", function(this, piece, length)
  if piece == PIECES then
    return nil
  end
  local near, far, forward = breadth(piece, length), breadth(piece + 1, length), G(length / PIECES)
  return BeginPolygon(),
    { Turn(90), G(near), Point() },
    { Turn(-90), G(near), Point() },
    { forward, Turn(-90), G(far), Point() },
    { forward, Turn(90), G(far), Point() },
    EndPolygon(),
    forward,
    Up(arch / PIECES),
    Rib(piece + 1, length)
end)
local result = plant:derive(leaves)

-- A leaf and an internode for each step, above the first internode. Two leaves later the plane is the same.
expect(result.counts, { Apex = 1, Leaf = 10, F = 11, Up = 10, Roll = 10 })
expect(result.objects[1]:position().z, 11, 1e-9)
-- Picture: --azimuth 110 --elevation 15
