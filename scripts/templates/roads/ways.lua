--!strict
-- Ways: streets through several positions.
local ways = {}

-- The heading (degrees) and the length (m) of the straight line from a junction to a position.
function ways.aim(this: Network, junction: number, x: number, y: number): (number, number)
  local from = this:place(junction)
  local dx, dy = x - from.x, y - from.y
  return math.deg(math.atan2(dy, dx)), math.sqrt(dx * dx + dy * dy)
end

-- Proposes a street through positions (m), x and y alternating, until a piece is refused or joins another street.
function ways.lead(this: Network, junction: number, way: { number }, depth: number, propose: any)
  local at: number? = junction
  for index = 1, #way, 2 do
    local heading, length = ways.aim(this, at :: number, way[index], way[index + 1])
    propose(this, at :: number, heading, length, depth)
    at = this:open_end(at :: number, heading)
    if not at then
      return
    end
  end
end

return ways
