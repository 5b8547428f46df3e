--!strict
-- Ways: streets that lead by several places.
local ways = {}

-- The heading (degrees) and the length (m) of the way to a place from a junction.
function ways.aim(this: Network, junction: number, x: number, y: number): (number, number)
  local from = this:place(junction)
  local dx, dy = x - from.x, y - from.y
  return math.deg(math.atan2(dy, dx)), math.sqrt(dx * dx + dy * dy)
end

-- Proposes a street by places (m), x and y in turn, until a piece is refused or joins another street.
function ways.lead(this: Network, junction: number, way: { number }, depth: number, propose: any)
  local at: number? = junction
  for index = 1, #way, 2 do
    local heading, length = ways.aim(this, at :: number, way[index], way[index + 1])
    propose(this, at :: number, heading, length, depth)
    at = this:reached(at :: number, heading)
    if not at then
      return
    end
  end
end

return ways
