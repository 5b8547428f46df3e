--!strict
-- Items of the plane by squares, so that those of a plan are found without comparing all of them. Lengths are in metres.
local squares = {}

local SIZE = 60

-- The square of a place; "+ 0" turns -0 into 0.
function squares.at(x: number, y: number): string
  return `{x // SIZE + 0},{y // SIZE + 0}`
end

-- The squares that the extent of a plan touches.
function squares.of(plan: any): { string }
  local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, corner in plan.rings[1] do
    for axis = 1, 2 do
      low[axis], high[axis] = math.min(low[axis], corner[axis]), math.max(high[axis], corner[axis])
    end
  end
  local found = {}
  for x = low[1] // SIZE, high[1] // SIZE do
    for y = low[2] // SIZE, high[2] // SIZE do
      table.insert(found, `{x + 0},{y + 0}`)
    end
  end
  return found
end

-- Adds an item to a square.
function squares.put<T>(into: { [string]: { T } }, square: string, item: T)
  local items = into[square] or {}
  into[square] = items
  table.insert(items, item)
end

return squares
