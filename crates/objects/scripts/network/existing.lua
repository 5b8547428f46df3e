-- Existing streets: a crossing, a sharp fork and a bridge stay unchanged, and `omitted` lists missing parts.
local Keep = module("Keep")
local existing = {
  { lines = { { { -90, 0 }, { 90, 0 } }, { { -40, -60 }, { -40, 60 } } }, depth = 0 },
  { lines = { { { -40, 0 }, { 90, 40 } } }, width = 9, lanes = 2, depth = 1 },
  { lines = { { { 50, -60 }, { 50, 90 } } }, level = 1, depth = 2 },
}
local roads = lsystem({ object = network({ existing = existing }) })
roads:axiom(Keep())
local streets = roads:derive(0).objects[1]
for _, part in streets:omitted() do
  print(`{part.name} lacks {part.length} m at {part.place}: {part.reason}`)
end
