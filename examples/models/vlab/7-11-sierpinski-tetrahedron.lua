--!strict
-- A tetrahedron of spheres: decomposition replaces it by four of half its size.
-- Source: Virtual Laboratory (cpfg), Open/11-light-sierp-tetra, University of Calgary.
local size = param("size", { default = 16, min = 1, max = 32, unit = "m", doc = "Edge; spheres measure 1 m" })
local low = param("low", { default = "#35508f", doc = "Colour at the bottom" })
local high = param("high", { default = "#f0e0a0", doc = "Colour at the top" })

local Part = module("Part", "size")

local fractal = lsystem({ object = turtle({ sides = 8 }) })
fractal:axiom(Part(size))
fractal:decompose("Part(s)", {
  when = function(this, s)
    return s > 1
  end,
}, function(this, s)
  local half = Part(s / 2)
  return { half }, { G(s / 2), half }, { Turn(90), G(s / 2), Turn(-90), half }, {
    Pitch(90),
    G(s / 2),
    Pitch(-90),
    half,
  }
end)
fractal:interpret("Part(s)", function(this)
  this:color(mix(low, high, this:position().z / size)):sphere(0.5)
end)
local result = fractal:derive(0)

-- Four parts of half the size: 4^4 spheres of 1 m in an edge of 16 m.
expect(result.counts.Part, 4 ^ 4)
