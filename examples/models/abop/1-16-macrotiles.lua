--!strict
-- Two space-filling curves by node rewriting: a tile becomes 3 x 3 tiles, or 4 x 4 tiles.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.16.
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of a square" })

local Tile, Mirror = module("Tile"), module("Mirror")
local SIGNS = { L = Tile(), R = Mirror(), F = F(), ["+"] = Left(), ["-"] = Right() }
local function word(signs: string)
  local modules = {}
  for sign in signs:gmatch(".") do
    table.insert(modules, SIGNS[sign])
  end
  return table.unpack(modules)
end

local function curve(tile: string, mirror: string, side: number, steps: number, place)
  local edge = size / (side ^ steps - 1)
  local pen = turtle({ step = edge, width = edge / 3, position = place, color = "#2f6b4f", sides = 4 })
  local system = lsystem({ object = pen, interpret = "last" })
  system:axiom(Right(), Tile())
  system:rule("Tile", function()
    return word(tile)
  end)
  system:rule("Mirror", function()
    return word(mirror)
  end)
  local derived = system:derive(steps)
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
