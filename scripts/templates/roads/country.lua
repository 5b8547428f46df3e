--!strict
-- Country roads: main streets continue out of a town, through the gardens and fields around it.
local areas = require("areas")
local checks = require("checks")

local country = {}

-- Begins country roads at all main streets that end at the outline.
local Roads = module("Roads")
-- A growing country road with its remaining length (m).
local CountryRoad = module("CountryRoad", "junction", "heading", "length", "rest", "tries")

country.Roads = Roads
country.GROWING = { "Roads", "CountryRoad(junction, heading, length, rest, tries)" }

-- The fraction of main streets that continue.
local SHARE = 1
-- The length (m) of a piece, and the minimum length of a road.
local PIECE, SHORTEST = 52, 52
-- The minimum angle (degrees) outside of the outline at the end of a main street.
local OUTSIDE = 165
-- The turns (degrees) of a refused road, one attempt after the other.
local ASIDE = { 14, -14, 28, -28 }
-- The maximum turn (degrees) between two pieces, and the pull towards the outward direction.
local SWING, OUTWARDS = 18, 0.25

-- The heading that continues a main street at a corner of the outline; nil if no main street ends there.
local function way_on(outside: any, corner: number, headings: { number }): number?
  local before = (corner - 2) % outside.count + 1
  local is_main, was_main = outside.depth[corner] == 0, outside.depth[before] == 0
  local open, middle = areas.angle(outside, corner)
  if open < OUTSIDE or is_main and was_main then
    return nil
  elseif is_main then
    return areas.heading(outside, corner) + 180
  elseif was_main then
    return areas.heading(outside, before)
  end
  -- The main street arrives from the inside, between two streets of the outline.
  return checks.nearest(middle + 180, headings) + 180
end

-- The rules of country roads around a centre; `inside` tests if a position is within the land of the town, and
-- `propose` proposes a street of a `depth`.
function country.rules(
  system: System<Network>,
  inside: (x: number, y: number) -> boolean,
  centre: { number },
  propose: any,
  depth: number
)
  local function bearing(place: Vector): number
    return math.deg(math.atan2(place.y - centre[2], place.x - centre[1]))
  end

  -- The length (m) of land from a position towards a heading.
  local function land(place: Vector, heading: number): number
    local east, north = math.cos(math.rad(heading)), math.sin(math.rad(heading))
    local far = 0
    while far < 600 and inside(place.x + (far + 20) * east, place.y + (far + 20) * north) do
      far += 20
    end
    return far
  end

  system:rule("Roads", function(this: Network)
    local corners = this:places()
    local outside: any = nil
    for _, each in areas.faces(this) do
      if each.face.area < 0 then
        outside = areas.read(each.face)
        break
      end
    end
    local modules: { any } = {}
    for corner = 1, if outside then outside.count else 0 do
      local junction = outside.junction[corner]
      local place = corners[junction]
      local heading = if place.depth == 0 then way_on(outside, corner, place.headings) else nil
      if heading and random() < SHARE then
        local rest = land(place.place, heading) * random(0.6, 1)
        if rest > SHORTEST then
          table.insert(modules, CountryRoad(junction, heading, PIECE, rest, 0))
        end
      end
    end
    return checks.successor(modules)
  end)

  system:rule(
    "CountryRoad(junction, heading, length, rest, tries)",
    function(this: Network, junction: number, heading: number, length: number, rest: number, tries: number)
      local at = this:open_end(junction, heading)
      if at then
        local place, left = this:place(at), rest - length
        if left < 0.5 * PIECE or not inside(place.x, place.y) then
          return nil
        end
        local turn = OUTWARDS * checks.between(heading, bearing(place)) + random(-SWING, SWING)
        return CountryRoad(at, heading + math.clamp(turn, -SWING, SWING), PIECE, left, 0)
      elseif not this:end_junction(junction, heading) and tries < #ASIDE then
        return CountryRoad(junction, heading + ASIDE[tries + 1], length, rest, tries + 1)
      end
      return nil
    end
  )

  system:interpret(
    "CountryRoad(junction, heading, length, rest, tries)",
    function(this: Network, junction: number, heading: number, length: number)
      propose(this, junction, heading, length, depth)
    end
  )
end

return country
