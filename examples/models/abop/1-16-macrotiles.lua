--!strict
-- Two space-filling curves by node rewriting: a tile becomes 3 x 3 tiles, or 4 x 4 tiles.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.16.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of a square" })

-- L is a tile, and R its mirror image.
local function curve(tile: string, mirror: string, side: number, steps: number, place: any)
  local edge = size / (side ^ steps - 1)
  local pen = turtle({ step = edge, width = edge / 3, position = place, color = "#2f6b4f", sides = 4 })
  local derived = abop({ axiom = "-L", L = tile, R = mirror, object = pen }):derive(steps)
  -- One edge less than there are tiles; the curve runs along one side of the square, from corner to corner.
  expect(derived.counts.F, side ^ (2 * steps) - 1)
  expect(derived.objects[1]:position():distance(place + vec(size, 0, 0)), 0, 1e-9 * size)
end

curve("LF+RFR+FL-F-LFLFL-FRFR+", "-LFLF+RFRFR+F+RF-LFL-FR", 3, 3, vec(0, 0, 0))
curve(
  "LFLF+RFR+FLFL-FRF-LFL-FR+F+RF-LFL-FRFRFR+",
  "-LFLFLF+RFR+FL-F-LF+RFR+FLF+RFRF-LFL-FRFR",
  4,
  2,
  vec(size * 1.2, 0, 0)
)

-- Picture: --azimuth 180 --elevation 0
