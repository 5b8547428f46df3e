--!strict
-- Six Koch curves from the same square: only the successor of an edge and the number of steps differ.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.9.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of each picture" })

-- The extent of a curve is that of its derived outline, in edges, and its corner the lowest left point.
local CURVES = {
  { steps = 4, edge = "FF-F-F-F-F-F+F", extent = 140, corner = { -8, -104 } },
  { steps = 4, edge = "FF-F-F-F-FF", extent = 81, corner = { 0, 0 } },
  { steps = 3, edge = "FF-F+F-F-FF", extent = 21, corner = { -13, -18 } },
  { steps = 4, edge = "FF-F--F-F", extent = 81, corner = { 0, 0 } },
  { steps = 5, edge = "F-FF--F-F", extent = 85, corner = { -41, -82 } },
  { steps = 4, edge = "F-F+F-F-F", extent = 37, corner = { -6, -6 } },
}

for k, curve in CURVES do
  local step = size / curve.extent
  local cell = vec((k - 1) % 3, 0, -math.floor((k - 1) / 3)) * (size * 1.15)
  local place = cell - vec(curve.corner[1], 0, curve.corner[2]) * step
  local pen = turtle({ step = step, width = size / 90, position = place, color = "#1f4e79", sides = 3 })
  local system = abop({ axiom = "F-F-F-F-", F = curve.edge, object = pen })

  -- Each edge becomes as many as its successor has, and the outline is closed.
  local derived = system:derive(curve.steps)
  local _, edges = curve.edge:gsub("F", "")
  expect(derived.counts.F, 4 * edges ^ curve.steps)
  expect(derived.objects[1]:position():distance(place), 0, 1e-9 * size)
end

-- Picture: --azimuth 180 --elevation 0
