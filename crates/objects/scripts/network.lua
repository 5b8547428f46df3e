local Tip = module("Tip", "junction", "heading", "depth")
local roads = lsystem({ object = network({ block_color = "#5f6f48" }) })
roads:axiom(Tip(1, 0, 0), Tip(1, 90, 0), Tip(1, 180, 0), Tip(1, 270, 0))
roads:rule("Tip(junction, heading, depth)", function(this, junction: number, heading: number, depth: number)
  local at = this:open_end(junction, heading)
  if not at then
    return nil
  end
  local on = Tip(at, heading + random(-8, 8), depth)
  return on, Tip(at, heading + 90, depth + 1), Tip(at, heading - 90, depth + 1)
end)
roads:interpret(
  "Tip(junction, heading, depth)",
  function(this, junction: number, heading: number, depth: number)
    this:grow(junction, heading, 90, depth)
  end
)
roads:derive(5)
