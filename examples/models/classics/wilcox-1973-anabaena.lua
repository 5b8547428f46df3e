--!strict
-- Heterocysts of Anabaena: cells grow, divide unequally, and exchange an inhibitor that heterocysts produce. A cell with
-- too little inhibitor becomes a heterocyst, so the distances of heterocysts stay about the same.
-- Source: M. Wilcox, G. Mitchison and R. Smith, Pattern formation in the blue-green alga Anabaena, 1973; as an L-system
-- in P. Prusinkiewicz, M. Hammel, J. Hanan and R. Mech, Visual models of plant development, 1997.
local steps = param("steps", { default = 360, min = 0, max = 600, step = 1, doc = "Steps of growth" })
local growth = param("growth", { default = 1.01, min = 1, max = 1.1, doc = "Growth of a cell in a step" })
local diffusion =
  param("diffusion", { default = 0.3, min = 0, max = 0.33, doc = "Part that flows in a step" })
local decay = param("decay", { default = 0.012, min = 0, max = 0.1, doc = "Part that decays in a step" })
local threshold =
  param("threshold", { default = 0.2, min = 0.001, max = 0.5, doc = "Inhibitor of new heterocysts" })
local CHANCE = 0.03 -- of a change in a step, so that two cells rarely change at once
local SPLIT = 0.45 -- length of the smaller daughter cell

local Cell = module("Cell", "length", "inhibitor")
local Heterocyst = module("Heterocyst")

local filament =
  lsystem({ object = turtle({ heading = { 1, 0, 0 }, sides = 12, width = 0.9 }), interpret = "last" })
filament:axiom(Heterocyst(), Cell(0.8, 0.9), Cell(1, 0.9), Heterocyst())

-- Growth and decay; a cell that is too long divides, into a short and a long cell.
local function grow(length: number, inhibitor: number): any
  local c = inhibitor * (1 - decay) / growth
  if c < threshold and random() < CHANCE then
    return Heterocyst()
  elseif length * growth > 2 then
    return Cell(2 * SPLIT, c), Cell(2 * (1 - SPLIT), c)
  end
  return Cell(length * growth, c)
end
filament:rule(
  "Cell(k, a) < Cell(l, c) > Cell(m, b)",
  function(this, k: number, a: number, l: number, c: number, m: number, b: number)
    return grow(l, c + diffusion * (a + b - 2 * c))
  end
)
-- A heterocyst holds the concentration 1.
filament:rule(
  "Heterocyst < Cell(l, c) > Cell(m, b)",
  function(this, l: number, c: number, m: number, b: number)
    return grow(l, c + diffusion * (1 + b - 2 * c))
  end
)
filament:rule(
  "Cell(k, a) < Cell(l, c) > Heterocyst",
  function(this, k: number, a: number, l: number, c: number)
    return grow(l, c + diffusion * (a + 1 - 2 * c))
  end
)
filament:interpret("Cell(length, inhibitor)", function(this, length, inhibitor)
  return Color(mix("#2f7f5f", "#cfe08a", inhibitor)), F(length - 0.1), G(0.1), Turn(5 * length)
end)
filament:interpret("Heterocyst", function()
  return G(0.5), Color("#d8a02f"), Sphere(0.75), G(0.6)
end)
local result = filament:derive(steps)

-- Heterocysts are never neighbours, because a new one fills its neighbours with inhibitor.
expect(result.chains[1]:find("Heterocyst Heterocyst") == nil, true)
-- Picture: --azimuth 180 --elevation 20
