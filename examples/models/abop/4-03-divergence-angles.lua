--!strict
-- The same pattern of florets with three divergence angles: only the golden angle, above, leaves no gaps.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 4.3.
local florets = param("florets", { default = 500, min = 1, max = 2000, step = 1, doc = "Number of florets" })

local Apex = module("Apex", "n")

local function head(divergence: number, place: any): any
  local pen = turtle({ position = place, color = "#c98f2c" })
  local system = lsystem({ object = pen, interpret = "last" })
  system:axiom(Apex(1))
  system:rule("Apex(n)", function(this, n: number)
    return { Turn(divergence * n), G(math.sqrt(n)), Sphere(0.8) }, Apex(n + 1)
  end)
  return system:derive(florets)
end

-- The distance from floret 500 to the nearest older one, after Vogel's formula.
local function gap(divergence: number): number
  local nearest = math.huge
  for older = 1, 499 do
    local turn = math.rad(divergence * older)
    local r, s = math.sqrt(500), math.sqrt(500 - older)
    nearest = math.min(nearest, math.sqrt(r * r + s * s - 2 * r * s * math.cos(turn)))
  end
  return nearest
end

for k, divergence in { 137.3, 137.5, 137.6 } do
  expect(head(divergence, vec((k - 2) * 26, 0, if k == 2 then 45 else 0)).counts.Sphere, 500)
end
-- A step makes a floret, and florets at the golden angle have the most room.
expect(gap(137.5) > math.max(gap(137.3), gap(137.6)), true)

-- Picture: --azimuth 180 --elevation 0
