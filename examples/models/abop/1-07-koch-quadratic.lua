--!strict
-- Two more Koch constructions: a quadratic island, and a snowflake curve with right angles.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.7.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the first square" })

local function curve(axiom: string, edge: string, n: number, step: number, place: any): any
  local pen = turtle({ step = step, width = size / 60, position = place, color = "#1f4e79", sides = 4 })
  return abop({ axiom = axiom, F = edge, object = pen }):derive(n)
end

-- 18 edges of a sixth replace an edge, and the island returns to its start.
local start = vec(0, 0, 0)
local island = curve("F-F-F-F-", "F+FF-FF-F-F+F+FF-F-F+F+FF+FF-F", 2, size / 36, start)
expect(island.counts.F, 4 * 18 ^ 2)
expect(island.objects[1]:position():distance(start), 0, 1e-9 * size)

-- 5 edges of a third replace an edge, so the ends stay in place.
local left, right = vec(size * 1.6, 0, -size * 0.4), vec(size * 3.4, 0, -size * 0.4)
local snowflake = curve("-F", "F+F-F-F+F", 4, size * 1.8 / 81, left)
expect(snowflake.counts.F, 5 ^ 4)
expect(snowflake.objects[1]:position():distance(right), 0, 1e-9 * size)

-- Picture: --azimuth 180 --elevation 0
