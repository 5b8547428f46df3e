--!strict
-- The Peano curve by node rewriting, on the square grid and on the grid turned by 45 degrees.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.17.
local size =
  param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "From one end to the other" })

-- L is a tile, and R its mirror image.
local function curve(tile: string, mirror: string, options: { [string]: any })
  local edge = size / math.sqrt(2) / (options.side ^ options.steps - 1)
  local pen = turtle({
    step = edge,
    angle = options.angle,
    width = edge / 3,
    position = options.place,
    color = "#2f6b4f",
    sides = 4,
  })
  local derived = abop({ axiom = options.axiom, L = tile, R = mirror, object = pen }):derive(options.steps)
  -- One edge less than there are tiles; the ends are opposite corners of the square.
  expect(derived.counts.F, options.side ^ (2 * options.steps) - 1)
  expect(derived.objects[1]:position():distance(options.place), size, 1e-9 * size)
end

curve(
  "LFRFL-F-RFLFR+F+LFRFL",
  "RFLFR+F+LFRFL-F-RFLFR",
  { side = 3, steps = 3, angle = 90, axiom = "L", place = vec(0, 0, 0) }
)
curve(
  "L+F+R-F-L+F+R-F-L-F-R+F+L-F-R-F-L+F+R-F-L-F-R-F-L+F+R+F+L+F+R-F-L+F+R+F+L-F-R+F+L+F+R-F-L+F+R-F-L",
  "R-F-L+F+R-F-L+F+R+F+L-F-R+F+L+F+R-F-L+F+R+F+L+F+R-F-L-F-R-F-L+F+R-F-L-F-R+F+L-F-R-F-L+F+R-F-L+F+R",
  { side = 5, steps = 2, angle = 45, axiom = "-L", place = vec(size * 0.9, 0, 0) }
)

-- Picture: --azimuth 180 --elevation 0
