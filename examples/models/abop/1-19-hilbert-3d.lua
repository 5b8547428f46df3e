--!strict
-- The Hilbert curve in three dimensions: each of four kinds of cubes becomes eight cubes, joined by seven edges.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, figure 1.19.
local steps = param("steps", { default = 2, min = 1, max = 4, step = 1, doc = "Steps of the derivation" })
local size = param("size", { default = 10, min = 1, max = 100, unit = "m", doc = "Side of the cube" })

local edge = size / (2 ^ steps - 1)
local pen = turtle({
  step = edge,
  width = edge / 4,
  palette = { "#c8452f", "#2f6fb0", "#3f8f4a", "#e0b23c" },
  roughness = 0.4,
})
local cube = abop({
  axiom = "A",
  A = "B-F+CFC+F-D&F^D-F+&&CFC+F+B//",
  B = "A&F^CFB^F^D^^-F-D^|F^B|FC^F^A//",
  C = "|D^|F^B-F+C^F^A&&FA&F^C+F+B^F^D//",
  D = "|CFB-F+B|FA&F^A&&FB-F+B|FC//",
  object = pen,
})
for number, letter in { "A", "B", "C", "D" } do
  cube:interpret(letter, function(this)
    this:paint(number):sphere(edge / 8)
  end)
end

local derived = cube:derive(steps)
-- One edge less than the 8^2 cubes; the curve ends at a corner next to its start.
expect(derived.counts.F, 8 ^ 2 - 1)
expect(derived.objects[1]:position():length(), 10, 1e-9)
