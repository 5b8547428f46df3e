--!strict
-- An inflorescence of lilac from measured data: decomposition builds the metamers, and widths follow the pipe model.
-- Source: Virtual Laboratory (cpfg), CPFG manual, Lilac (data of the cultivar Congo), University of Calgary.
local angle = param("angle", { default = 45, min = 10, max = 80, unit = "deg", doc = "Branching angle" })
local scale =
  param("scale", { default = 0.01, min = 0.001, max = 0.1, doc = "Size by that of the data (mm)" })
local petals = param("petals", { default = "#a878c8", doc = "Colour of the petals" })

-- For each order of axes: the number of internodes, their lengths (mm), and the internodes of the lateral axes.
local COUNT = { 13, 7, 2, 1 }
local LENGTH = {
  { 15.5, 13.1, 38.9, 19.8, 33.3, 21.2, 25.6, 16.2, 12.4, 9.0, 1.4, 0, 0 },
  { 8.8, 8.0, 7.7, 4.1, 4.5, 4.4, 1.1 },
  { 4.0, 4.9 },
  { 5.0 },
}
local LATERAL = { { 7, 7, 7, 7, 6, 6, 6, 5, 4, 3, 2, 1 }, { 2, 2, 1, 1, 1, 1 }, { 1 } }

local Apex, Floret = module("Apex", "order", "index"), module("Floret")
local Internode = module("Internode", "order", "index", "pipes")

local lilac = lsystem({ object = turtle({ sides = 5, color = "#6f8f4a" }), interpret = "last" })
lilac:consider("Internode")
lilac:axiom(Apex(1, 1))
lilac:decompose("Apex(order, i)", function(this, order, i): any
  if i == COUNT[order] then
    return Internode(order, i, 1), Floret()
  end
  local lateral = Apex(order + 1, COUNT[order + 1] - LATERAL[order][i] + 1)
  return Internode(order, i, 1),
    { Turn(angle), Roll(90), lateral },
    { Turn(-angle), Roll(90), lateral },
    Roll(85),
    Apex(order, i + 1)
end)
lilac:rule(
  "Internode(o, i, p) > [Internode(o1, i1, p1)] [Internode(o2, i2, p2)] Internode(o3, i3, p3)",
  function(
    this,
    o: number,
    i: number,
    p: number,
    o1: number,
    i1: number,
    p1: number,
    o2: number,
    i2: number,
    p2: number,
    o3: number,
    i3: number,
    p3: number
  )
    return Internode(o, i, p1 + p2 + p3)
  end
)
lilac:interpret("Internode(order, i, pipes)", function(this, order, i, pipes)
  return Width(scale * pipes ^ 0.4), F(scale * LENGTH[order][i])
end)
lilac:interpret("Floret", function()
  local parts: any = { Color(petals) }
  for k = 1, 4 do
    table.insert(parts, {
      Roll(k * 90),
      Turn(50),
      BeginPolygon(),
      Point(),
      { Turn(35), G(scale * 2.5), Point() },
      { G(scale * 4.5), Point() },
      { Turn(-35), G(scale * 2.5), Point() },
      EndPolygon(),
    })
  end
  return table.unpack(parts)
end)
local result = lilac:derive(14)

-- Axes with n internodes carry 1, 3, 5, 7, 9, 15, 21 florets for n = 1 to 7, and each axis of the panicle is there
-- twice: 2 (4 * 21 + 3 * 15 + 9 + 7 + 5 + 3 + 1) + 1 florets. Each of them sends one pipe to the base.
expect(result.counts.Floret, 309)
expect(result.chains[1]:match("^Internode%(1,1,(%d+)%)"), "309")
