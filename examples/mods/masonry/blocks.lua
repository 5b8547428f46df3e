--!strict
-- Upright blocks for extruders. The extruder must point up before and after, so that x and y are those of the world.
local blocks = {}

-- Draws a block around `foot`: `length` along `way`, `thick` across it, and `height` high (all in m).
function blocks.block(this, foot, way, length: number, thick: number, height: number)
  local across = vec(-way.y, way.x, 0) * (thick / 2)
  local half = vec(way.x, way.y, 0) * (length / 2)
  local corners = {}
  for _, corner in { half - across, half + across, across - half, half * -1 - across } do
    table.insert(corners, { corner.x, corner.y })
  end
  this:jump(foot):polygon(corners):scale(1):extrude(height)
end

return blocks
