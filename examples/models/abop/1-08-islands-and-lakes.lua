--!strict
-- Islands and lakes: the outline leaves out moves, which become six times longer in each step, as the edges do.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.8.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the first square" })
local steps = param("steps", { default = 2, min = 0, max = 3, step = 1, doc = "Steps of the derivation" })

local coast = turtle({ step = size / 6 ^ steps, width = size / 80, color = "#1f4e79", sides = 4 })
local sea = abop({
  axiom = "F+F+F+F+",
  F = "F+f-FF+F+FF+Ff+FF-f+FF-F-FF-Ff-FFF",
  f = "ffffff",
  object = coast,
})

local derived = sea:derive(steps)
-- An edge becomes 18 edges and 4 moves, a move becomes 6: 4 * 18^2 edges, and (4 * 4) * 6 + (4 * 18) * 4 moves.
expect({ F = derived.counts.F, G = derived.counts.G }, { F = 1296, G = 384 })
expect(derived.objects[1]:position():length(), 0, 1e-9 * size)

-- Picture: --azimuth 180 --elevation 0
