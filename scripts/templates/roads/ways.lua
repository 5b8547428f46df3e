--!strict
-- Ways: streets that lead by several places.
local ways = {}

-- Proposes a street from a junction towards a heading (degrees), with a length (m) and a depth.
export type Propose = (
  network: Network,
  junction: number,
  heading: number,
  length: number,
  depth: number
) -> ()

-- The heading (degrees) and the length (m) of the way to a place from a junction.
function ways.aim(this: Network, junction: number, x: number, y: number): (number, number)
  local from = this:place(junction)
  local dx, dy = x - from.x, y - from.y
  return math.deg(math.atan2(dy, dx)), math.sqrt(dx * dx + dy * dy)
end

-- Proposes a street by places (m), x and y in turn, until a piece is refused or joins another street.
function ways.lead(this: Network, junction: number, way: { number }, depth: number, propose: Propose)
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

-- The junction where a street by places ends that was proposed before, and whether it came to the last place or joined another
-- street.
function ways.follow(this: Network, junction: number, way: { number }): (number, boolean)
  local at = junction
  for index = 1, #way, 2 do
    local heading = ways.aim(this, at, way[index], way[index + 1])
    local reached = this:reached(at, heading)
    if not reached then
      local arrived = this:arrived(at, heading)
      return arrived or at, arrived ~= nil
    end
    at = reached
  end
  return at, true
end

return ways
