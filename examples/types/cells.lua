--!strict
-- A type without a shape of its own: a field of cells. Rules read the neighbourhood of a cell in the last pass,
-- so the chain grows like coral: a cell divides if there is room, and stops if it is crowded.

local cells = object("cells", {
  doc = "A field of unit cells that knows which of them are taken.",
  fields = { size = { default = 0.92, min = 0.1, max = 1, unit = "m", doc = "Edge of a cube." } },
  state = { taken = {}, cube = extruder() },
  reads = {
    crowd = {
      doc = "How many of the 26 cells around this one are taken.",
      function(self, x: number, y: number, z: number)
        local count = 0
        for dx = -1, 1 do
          for dy = -1, 1 do
            for dz = -1, 1 do
              if self.taken[`{x + dx} {y + dy} {z + dz}`] then
                count += 1
              end
            end
          end
        end
        return count - (if self.taken[`{x} {y} {z}`] then 1 else 0)
      end,
    },
    free = {
      doc = "Whether a cell is not taken.",
      function(self, x: number, y: number, z: number)
        return not self.taken[`{x} {y} {z}`]
      end,
    },
  },
  changes = {
    take = {
      doc = "Takes a cell and draws its cube.",
      function(self, x: number, y: number, z: number, age: number)
        local key = `{x} {y} {z}`
        if self.taken[key] then
          return
        end
        self.taken[key] = true
        local warm = math.clamp(age / 24, 0, 1)
        self.cube:color({ 0.55 + 0.4 * warm, 0.16 + 0.5 * warm, 0.2 + 0.12 * warm })
        self.cube:jump({ x, y, z }):rectangle(self.size, self.size):extrude(self.size)
      end,
    },
  },
})

local steps = param("steps", { default = 34, min = 1, max = 80, step = 1 })
local crowd =
  param("crowd", { default = 3, min = 1, max = 26, step = 1, doc = "Neighbours that leave no room" })

local Cell = module("Cell", "x", "y", "z", "age")
local Tip = module("Tip", "x", "y", "z", "age")

local WAYS = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, 1 } }

local coral = lsystem({ object = cells() })
coral:axiom(Tip(0, 0, 0, 0), Tip(4, 1, 0, 0), Tip(1, 5, 0, 0), Tip(6, 6, 0, 0))
coral:rule("Tip(x, y, z, age)", function(this, x, y, z, age)
  local way = WAYS[math.floor(random(1, #WAYS + 1))]
  local nx, ny, nz = x + way[1], y + way[2], z + way[3]
  if nz > 0 and this:free(nx, ny, nz) and this:crowd(nx, ny, nz) <= crowd then
    return Cell(x, y, z, age), Tip(nx, ny, nz, age + 1), Tip(x, y, z, age)
  end
  -- Without room, the cell may try again or rest forever.
  if random() < 0.08 then
    return Cell(x, y, z, age)
  end
  return
end)
coral:interpret("Cell(x, y, z, age)", function(this, x, y, z, age)
  this:take(x, y, z, age)
end)
coral:interpret("Tip(x, y, z, age)", function(this, x, y, z, age)
  this:take(x, y, z, age)
end)
coral:derive(steps)

return cells
