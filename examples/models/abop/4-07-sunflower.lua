--!strict
-- A sunflower head: the number of a primordium decides on its organ, from seeds in the middle to florets and petals.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.7.
local organs = param("organs", { default = 630, min = 100, max = 1500, step = 1, doc = "Number of organs" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "Between organs" })
local petals = param("petals", { default = "#f2b422", doc = "Colour of the petals" })

-- A petal of 1 m along the heading, with two sides that meet in a fold.
local function petal(color)
  local system = lsystem({ object = turtle({ color = color, roughness = 0.6 }) })
  local function half(side: number): any
    return {
      Roll(side * 14),
      BeginPolygon(),
      Point(),
      { Turn(side * 22), G(0.42), Point() },
      { Turn(side * 13), G(0.75), Point() },
      { G(1), Point() },
      EndPolygon(),
    }
  end
  system:axiom(half(1), half(-1))
  return system:derive()
end
local yellow, green = petal(petals), petal("#5f8f3c")

local Apex, Organ = module("Apex", "n"), module("Organ", "n")
local head = lsystem({ object = turtle({ sides = 6 }), interpret = "last" })
head:axiom(Apex(1))
head:rule("Apex(n)", function(this, n: number)
  return { Turn(divergence * n), G(math.sqrt(n)), Organ(n) }, Apex(n + 1)
end)

-- The turtle heads outwards; the head faces the direction of the turtle's up, and petals lean towards it.
head:interpret("Organ(n)", function(this, n: number)
  if n <= 440 then
    this:color(mix("#6b4a22", "#2f2013", n / 440)):sphere(1.05)
  elseif n <= 565 then
    this:color("#8a5a1c"):sphere(1.05)
    return Up(60), Width(0.5), F(1.6), Color("#e0a52c"), Sphere(0.5)
  else
    -- Four rings, the outer ones flatter, and green bracts behind them.
    local ring = math.min((n - 565) // 15, 4)
    local model, length = if ring < 4 then yellow else green, if ring < 4 then 15 else 9
    return Up(38 - ring * 12), Place(model, length)
  end
  return nil
end)

-- A step makes one organ.
local derived = head:derive(organs)
expect(derived.counts.Organ, 630)

-- Picture: --azimuth 180 --elevation 0
