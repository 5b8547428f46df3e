--!strict
-- Penrose's tiling by two rhombs: four symbols walk along the tiles, and only the edges of the last step are drawn.
-- Source: R. Penrose, Pentaplexity: a class of non-periodic tilings of the plane, 1979; L-system in the library of
-- Fractint, H. Savage.
local steps = param("steps", { default = 4, min = 1, max = 5, step = 1, doc = "Steps of division" })
local color = param("color", { default = "#35406f", doc = "Colour of the edges" })

local W, X, Y, Z = module("W"), module("X"), module("Y"), module("Z")

local function turn(tenths: number): any
  return Turn(36 * tenths)
end

local tiling = lsystem({ object = turtle({ width = 0.14, color = color, sides = 5 }), interpret = "last" })
tiling:axiom({ X() }, turn(2), { X() }, turn(2), { X() }, turn(2), { X() }, turn(2), { X() })
tiling:rule("W", function()
  return Y(),
    F(1),
    turn(2),
    Z(),
    F(1),
    turn(-4),
    X(),
    F(1),
    { turn(-1), Y(), F(1), turn(-4), W(), F(1) },
    turn(2)
end)
tiling:rule("X", function()
  return turn(1), Y(), F(1), turn(-2), Z(), F(1), { turn(-3), W(), F(1), turn(-2), X(), F(1) }, turn(1)
end)
tiling:rule("Y", function()
  return turn(-1), W(), F(1), turn(2), X(), F(1), { turn(3), Y(), F(1), turn(2), Z(), F(1) }, turn(-1)
end)
tiling:rule("Z", function()
  return turn(-2),
    Y(),
    F(1),
    turn(4),
    W(),
    F(1),
    { turn(1), Z(), F(1), turn(4), X(), F(1) },
    turn(-2),
    X(),
    F(1)
end)
tiling:rule("F", function()
  return nil
end)
local result = tiling:derive(steps)

-- The last step makes an edge after each symbol, and the numbers of symbols follow from the rules.
local w, x, y, z = 0, 5, 0, 0
for _ = 1, 4 do
  w, x, y, z = w + x + y + z, w + x + y + 2 * z, 2 * w + x + y + z, w + x + y + z
end
expect(result.counts.F, w + x + y + z)
expect(result.counts.W, w)
-- Picture: --azimuth 180 --elevation 0
