--!strict
-- A Menger sponge: 8,000 cubes in one mesh.
local Sponge, Cube = module("Sponge", "n", "x", "y", "z"), module("Cube", "x", "y", "z")
local sponge = lsystem({ object = extruder({ smooth = false }), interpret = "last" })

sponge:axiom(Sponge(3, 0, 0, 0))

sponge:rule("Sponge(n, x, y, z)", function(this, n, x, y, z)
  if n == 0 then
    return Cube(x, y, z)
  end
  local size = 3 ^ (n - 1)
  local parts = {}
  for cell = 0, 26 do
    local i, j, k = cell % 3, math.floor(cell / 3) % 3, math.floor(cell / 9)
    local middles = (i == 1 and 1 or 0) + (j == 1 and 1 or 0) + (k == 1 and 1 or 0)
    if middles < 2 then
      table.insert(parts, Sponge(n - 1, x + i * size, y + j * size, z + k * size))
    end
  end
  return sequence(parts)
end)

sponge:interpret("Cube(x, y, z)", function(this, x, y, z)
  this:jump({ x + 0.5, y + 0.5, z }):rectangle(1, 1):extrude(1)
end)

sponge:derive(4)
