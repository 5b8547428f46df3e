--!strict
-- A bush of random branches: each bud chooses one of several outcomes by weight. Another seed (burgeon run
-- scripts/bush.lua --seed 7) gives another bush of the same kind.
local years = param("years", { default = 7, min = 1, max = 9, step = 1, doc = "How often the buds open" })
local stems = param("stems", { default = 7, min = 1, max = 15, step = 1, doc = "Stems out of the ground" })
local spread = param("spread", { default = 38, min = 10, max = 70, unit = "deg", doc = "Between branches" })
local berries = param("berries", { default = 1, min = 0.1, max = 5, doc = "Weight of berries (leaves: 4)" })
local green = param("green", { default = "#5f8f3c", doc = "Colour of the leaves" })

local Bud = module("Bud", "length", "width")
local Sprig = module("Sprig", "length")
local Twig = module("Twig", "length", "width")
local Leaf = module("Leaf", "size", "tint")
local Berry = module("Berry", "radius")

local function leaf(color)
  local system = lsystem({ object = turtle({ color = color, roughness = 0.6 }) })
  local function half(side: number)
    return {
      Roll(side * 24),
      BeginPolygon(),
      Point(),
      { Turn(side * 36), G(0.4), Point() },
      { Turn(side * 22), G(0.7), Point() },
      { G(1), Point() },
      EndPolygon(),
    }
  end
  system:axiom(half(1), half(-1))
  return system:derive()
end
local blades = { leaf(mix(green, "#1d3b1a", 0.35)), leaf(green), leaf(mix(green, "#d9e07a", 0.35)) }

local bush =
  lsystem({ object = turtle({ color = "#6a4b35", sides = 6, elasticity = -0.24 }), interpret = "last" })

local around = {}
for k = 1, stems do
  table.insert(around, { Roll(k * 137.5), Pitch(6 + 30 * k / stems), Twig(0.2, 0.055), Bud(0.42, 0.05) })
end
bush:axiom(table.unpack(around))

-- A bud forks in two or three, continues, or stops growing.
bush:rule("Bud(l, w)", { weight = 4 }, function(this, l, w)
  return Twig(l * random(0.7, 1.2), w),
    Sprig(l),
    { Turn(spread * random(0.6, 1.2)), Roll(random(60, 120)), Bud(l * 0.82, w * 0.72) },
    { Turn(-spread * random(0.6, 1.2)), Roll(random(60, 120)), Bud(l * 0.82, w * 0.72) }
end)
bush:rule("Bud(l, w)", { weight = 3 }, function(this, l, w)
  return Twig(l * random(0.7, 1.2), w),
    Sprig(l),
    { Turn(spread), Roll(90), Bud(l * 0.75, w * 0.62) },
    { Roll(120), Turn(spread), Roll(90), Bud(l * 0.75, w * 0.62) },
    { Roll(240), Turn(spread), Roll(90), Bud(l * 0.75, w * 0.62) }
end)
bush:rule("Bud(l, w)", { weight = 2 }, function(this, l, w)
  return Twig(l, w), Sprig(l), Roll(random(0, 360)), Turn(random(-15, 15)), Bud(l * 0.9, w * 0.85)
end)
bush:rule("Bud(l, w)", { weight = 0.5 }, function(this, l, w)
  return Twig(l * 0.5, w), Sprig(l), Sprig(l)
end)

-- A sprig has leaves, or rarely a bunch of berries.
bush:rule("Sprig(l)", { weight = 4 }, function(this, l)
  local leaves = {}
  for k = 1, 4 do
    table.insert(
      leaves,
      { Roll(k * 90 + random(-30, 30)), Turn(random(35, 70)), Leaf(random(0.09, 0.16), random(0, 3)) }
    )
  end
  return table.unpack(leaves)
end)
bush:rule("Sprig(l)", { weight = berries }, function(this, l)
  local bunch = {}
  for k = 1, 3 do
    table.insert(bunch, { Roll(k * 120), Turn(50), Twig(0.06, 0.006), Berry(random(0.02, 0.028)) })
  end
  return table.unpack(bunch)
end)

bush:interpret("Twig(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)
bush:interpret("Leaf(size, tint)", function(this, size, tint)
  this:place(blades[math.floor(tint) + 1], size)
end)
bush:interpret("Berry(r)", function(this, r)
  this:color("#c62f38")
  this:sphere(r)
end)

bush:derive(years + 1)
