--!strict
-- Greens: triangles of grass between two adjacent streets of a junction and a third street that joins them.
local greens = {}

-- A side street that leaves around a green after some steps: its heading, the heading of the street that it leaves,
-- and the side (m) of the green between them.
local Fork = module("Fork", "junction", "heading", "along", "side", "depth", "wait", "left")
-- The third side of a green.
local ForkArm = module("ForkArm", "junction", "heading", "length", "depth")

-- The lengths (m) of the sides of a green, at a main street and elsewhere, and its angle (degrees). With equal sides,
-- its other angles are large enough for most networks.
local SIDE = { main = { 54, 80 }, other = { 43, 56 } }
local ANGLE = { 62, 76 }

-- The module of a green at a junction, to the left (1) or to the right (-1) of the street that arrived with a
-- heading.
function greens.fork(
  junction: number,
  heading: number,
  hand: number,
  depth: number,
  wait: number,
  left: number
): any
  local sides = if depth == 0 then SIDE.main else SIDE.other
  -- The green leans back, because the arriving street is there, and the street ahead can turn.
  local lean = hand * random(ANGLE[1], ANGLE[2])
  local side = random(sides[1], sides[2])
  return Fork(junction, heading + 180 + lean, heading + 180, side, depth + 1, wait, left)
end

-- The rules of greens. `onward` returns the module of a street that continues from the end of a fork, and `propose`
-- proposes a street.
function greens.rules(
  system: System<Network>,
  onward: (
    network: Network,
    junction: number,
    heading: number,
    depth: number,
    left: number
  ) -> any,
  propose: (
    network: Network,
    junction: number,
    heading: number,
    length: number,
    depth: number
  ) -> ()
)
  system:rule(
    "Fork(junction, heading, along, side, depth, wait, left)",
    function(
      this: Network,
      junction: number,
      heading: number,
      along: number,
      side: number,
      depth: number,
      wait: number,
      left: number
    )
      if left <= 0 then
        return nil
      elseif wait > 0 then
        return Fork(junction, heading, along, side, depth, wait - 1, left - 1)
      end
      local at = this:open_end(junction, heading)
      if not at then
        return nil
      end
      local function way(aim: number): Vector
        return side * vec(math.cos(math.rad(aim)), math.sin(math.rad(aim)), 0)
      end
      local across = way(along) - way(heading)
      local modules: { any } = { onward(this, at, heading, depth, left - 1) }
      table.insert(modules, ForkArm(at, math.deg(math.atan2(across.y, across.x)), across:length(), depth))
      return table.unpack(modules)
    end
  )
  system:rule("ForkArm", function()
    return nil
  end)
  system:interpret(
    "Fork(junction, heading, along, side, depth, wait, left)",
    function(
      this: Network,
      junction: number,
      heading: number,
      _: number,
      side: number,
      depth: number,
      wait: number
    )
      if wait == 0 then
        propose(this, junction, heading, side, depth)
      end
    end
  )
  system:interpret(
    "ForkArm(junction, heading, length, depth)",
    function(this: Network, junction: number, heading: number, length: number, depth: number)
      propose(this, junction, heading, length, depth)
    end
  )
end

return greens
