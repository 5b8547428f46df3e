--!strict
-- Gaps: land without streets, because growth can end early by chance.
local gaps = {}

-- The streets into such land, by the options of a town. `start` returns the tip of a street that leaves a junction,
-- or nil.
function gaps.tips(this: Network, of: any, start: any, left: number): { any }
  local modules = {}
  local people: ((number, number) -> number)? = of.people
  -- Prefer junctions where a street only turns, because they do not become junctions of four.
  for at, corner in this:places() do
    local place, degree = corner.place, #corner.headings
    local depth = math.min(corner.depth + 1, of.deepest)
    local pattern = of.pattern_at(place.x, place.y)
    if pattern.room then
      continue
    end
    -- The lengths of free land around a position: short for a dead end, longer for a turn, so that gaps remain. A
    -- fourth street leaves a junction only for much land, and for very much land if streets leave one at a time.
    local free = if degree < 2 then 1.1 elseif degree == 2 then 2 elseif pattern.both > 0 then 2.2 else 6
    local room = math.max(3 - degree, 1)
    for turn = 0, 270, 90 do
      local heading = of.headings[1] + turn
      local length = pattern.length(place.x, place.y, heading, depth)
      local way = (free + 0.4) * length * vec(math.cos(math.rad(heading)), math.sin(math.rad(heading)), 0)
      local ahead = place + way
      local is_peopled = people == nil or people(ahead.x, ahead.y) > 0.02
      if room > 0 and of.inside(ahead.x, ahead.y) and is_peopled and this:distance(ahead) > free * length then
        local tip = start(pattern, at, place.x, place.y, heading, depth, 0, left)
        room -= if tip then 1 else 0
        table.insert(modules, tip)
      end
    end
  end
  return modules
end

return gaps
