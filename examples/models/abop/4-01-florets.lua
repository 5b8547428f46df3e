--!strict
-- The florets of a sunflower head after H. Vogel: floret n is at the golden angle from the one before, at a distance of
-- the square root of n.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.1.
local florets = param("florets", { default = 500, min = 1, max = 2000, step = 1, doc = "Number of florets" })
local divergence =
  param("divergence", { default = 137.5, min = 0, max = 180, unit = "deg", doc = "Between florets" })

local Apex, Floret = module("Apex", "n"), module("Floret", "n")
local head = lsystem({ object = turtle({}), interpret = "last" })
head:axiom(Apex(1))
head:rule("Apex(n)", function(this, n: number)
  return { Turn(divergence * n), G(math.sqrt(n)), Floret(n) }, Apex(n + 1)
end)
head:interpret("Floret(n)", function(this, n: number)
  this:color(mix("#e9b93a", "#7a3f1a", math.floor(n / florets * 12) / 12)):sphere(0.95)
end)

local derived = head:derive(florets)
-- A step makes one floret.
expect(derived.counts.Floret, 500)

-- The place of a floret in Vogel's formula; the foremost point of each sphere is drawn there.
local function place(n: number): any
  local turn = math.rad(divergence * n)
  return vec(-math.sin(turn), 0, math.cos(turn)) * math.sqrt(n)
end
for n = 1, florets do
  expect(derived.objects[1]:distance(place(n) + vec(0, 0.95, 0)), 0, 1e-6)
end
-- The nearest older floret is a Fibonacci number older: the parastichies, more of them towards the edge.
local function nearest(n: number): number
  local best = 1
  for older = 2, n - 1 do
    if place(n):distance(place(n - older)) < place(n):distance(place(n - best)) then
      best = older
    end
  end
  return best
end
expect({ nearest(20), nearest(40), nearest(100), nearest(200), nearest(500) }, { 8, 13, 21, 34, 55 })

-- Picture: --azimuth 180 --elevation 0
