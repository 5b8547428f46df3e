--!strict
-- Six simple leaves as polygons: the midrib and the lateral veins grow at rates of their own, and the growth potential
-- of a vein decreases in each step, which gives the outline.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 5.6.
local size = param("size", { default = 1, min = 0.1, max = 10, unit = "m", doc = "Length of each midrib" })
local angle =
  param("angle", { default = 60, min = 20, max = 90, unit = "deg", doc = "Between midrib and veins" })
local steps = param("steps", { default = 20, min = 5, max = 24, step = 1, doc = "Steps of the derivation" })

-- First lengths and growth rates of the midrib and of the veins, and the decrease of the growth potential.
local LEAVES = {
  { rib = 5, rib_rate = 1, vein = 1, vein_rate = 1, decrease = 0 },
  { rib = 5, rib_rate = 1, vein = 1, vein_rate = 1, decrease = 1 },
  { rib = 5, rib_rate = 1, vein = 0.6, vein_rate = 1.06, decrease = 0.25 },
  { rib = 5, rib_rate = 1.2, vein = 10, vein_rate = 1, decrease = 0.5 },
  { rib = 5, rib_rate = 1.2, vein = 4, vein_rate = 1.1, decrease = 0.25 },
  { rib = 5, rib_rate = 1.1, vein = 1, vein_rate = 1.2, decrease = 1 },
}

local Apex, Vein = module("Apex", "time"), module("Vein", "potential")
local Part = module("Part", "length", "rate")

for k, leaf in LEAVES do
  -- The midrib: a segment of each step, which has grown in all later steps.
  local length = 0
  for n = 0, steps - 1 do
    length += leaf.rib * leaf.rib_rate ^ n
  end
  local place = vec((k - 1) % 3 * 0.7, 0, -((k - 1) // 3) * 1.15) * size
  local system = lsystem({ object = turtle({ position = place, color = "#4f8a35" }), interpret = "last" })
  -- The outline runs up along the tips of the left veins and down along those of the right ones.
  system:axiom(BeginPolygon(), Point(), Apex(0), EndPolygon())
  system:rule("Apex(t)", function(this, t: number)
    return Part(leaf.rib, leaf.rib_rate),
      { Left(angle), Vein(t), Point() },
      { Apex(t + 1) },
      { Right(angle), Vein(t), Point() }
  end)
  system:rule("Vein(t)", {
    when = function(this, t)
      return t > 0
    end,
  }, function(this, t)
    return Part(leaf.vein, leaf.vein_rate), Vein(t - leaf.decrease)
  end)
  system:rule("Part(length, rate)", function(this, l: number, rate: number)
    return Part(l * rate, rate)
  end)
  system:interpret("Part(length, rate)", function(this, l: number)
    this:advance(l * size / length)
  end)

  local derived = system:derive(steps)
  -- Two points of the outline for each step, and its base.
  expect(derived.counts.Point, 2 * 20 + 1)
  -- The two veins of step n + 1 get a part in each later step, until the potential n is used up. All parts grow in the
  -- steps after their own. The ends of the veins are the corners of the outline.
  local parts, height = 0, 0
  for n = 0, steps - 1 do
    local later = if n == 0 then 0 else math.min(steps - 1 - n, math.ceil(n / leaf.decrease))
    local vein = 0
    for step = n + 2, n + 1 + later do
      vein += leaf.vein * leaf.vein_rate ^ (steps - step)
    end
    parts += 1 + 2 * later
    height += leaf.rib * leaf.rib_rate ^ (steps - 1 - n)
    local turn = math.rad(angle)
    for side = -1, 1, 2 do
      local corner = vec(side * vein * math.sin(turn), 0, height + vein * math.cos(turn)) * (size / length)
      expect(derived.objects[1]:distance(place + corner), 0, 1e-6)
    end
  end
  expect(derived.counts.Part, parts)
end

-- Picture: --azimuth 180 --elevation 0
