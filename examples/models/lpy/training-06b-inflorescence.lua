--!strict
-- Inflorescences by vegetativeness: it falls with time, and young lateral apices have less of it. An apex with too little
-- becomes a flower. Panicles, racemes and cymes differ only in numbers.
-- Source: L-Py, training/06b-dev-inflo-archi, F. Boudon and C. Godin, after P. Prusinkiewicz, Y. Erasmus, B. Lane,
-- L. Harder and E. Coen, Evolution and development of inflorescence architectures, 2007.
local time =
  param("time", { default = 10, min = 0, max = 20, doc = "Age of the inflorescence (plastochrons)" })
local decrease =
  param("decrease", { default = 0.2, min = 0.05, max = 1, doc = "Rate at which vegetativeness falls" })
local difference =
  param("difference", { default = 50, min = -50, max = 80, doc = "Vegetativeness that young apices lack" })
local duration = param("duration", { default = 3, min = 0, max = 5, doc = "Time in which apices are young" })
local angle =
  param("angle", { default = 40, min = 10, max = 80, unit = "deg", doc = "Angle of the branches" })
local STEP, THRESHOLD = 0.1, 20

local Apex, Flower = module("Apex", "wait", "age"), module("Flower", "age")
local Internode, Bract = module("Internode", "age"), module("Bract", "age")

local function vegetativeness(age: number): number
  return 100 * math.exp(-decrease * step() * STEP) - (if age < duration then difference else 0)
end

local plant = lsystem({ object = turtle({ width = 0.14, color = "#6f8f4a", sides = 6 }), interpret = "last" })
plant:axiom(Internode(0), Apex(0, 100))
plant:rule("Apex(wait, age)", function(this, wait, age)
  if vegetativeness(age) < THRESHOLD then
    return Flower(0)
  elseif wait < 1 - STEP / 2 then
    return Apex(wait + STEP, age + STEP)
  end
  return Internode(0),
    { Turn(angle + 30), Bract(0) },
    { Turn(angle), Apex(0, 0) },
    Roll(180),
    Apex(0, age + STEP)
end)
local organs: { [string]: any } = { Internode = Internode, Bract = Bract, Flower = Flower }
for name, organ in organs do
  plant:rule(name .. "(age)", function(this, age: number)
    return organ(age + STEP)
  end)
end
local function grown(age: number): number
  return ease.smooth(math.clamp(age / 2, 0, 1))
end
plant:interpret("Internode(age)", function(this, age)
  return F(grown(age))
end)
plant:interpret("Bract(age)", function(this, age)
  local size = 0.35 * grown(age)
  return Color("#4f8f3c"),
    BeginPolygon(),
    Point(),
    { Turn(25), G(size), Point() },
    { G(2 * size), Point() },
    { Turn(-25), G(size), Point() },
    EndPolygon()
end)
plant:interpret("Flower(age)", function(this, age)
  return F(0.3 * grown(age)), Color("#d05a9f"), Sphere(0.08 + 0.17 * grown(age))
end)
local result = plant:derive(time / STEP)

-- The main apex flowers when 100 exp(-0.2 t) = 20, at t = 8.05. It makes an internode every 1.1 (ten steps and the one of
-- division): seven, above the first. Nothing is vegetative at t = 10.
local _, brackets = result.chains[1]:gsub("%b[]", "")
expect(result.counts.Apex, 0)
expect(brackets, 2 * math.floor(math.log(5) / 0.2 / 1.1))
-- Picture: --azimuth 180 --elevation 0
