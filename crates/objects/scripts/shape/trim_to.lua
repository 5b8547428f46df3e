-- Panels on the walls of a house and on its hip roof, which meet at the corners and hips.
local house = cuboid(8, 6, 3)
for _, wall in house:faces("side") do
  local panel = wall:offset(0.2)[1]:extrude(0.15):trim_to(wall)
  print(if panel then panel:volume() else 0)
end
local slope = rectangle(8, 6):roof({ kind = "hip", height = 2 }):faces("slanted")[1]
local tiles = slope:offset(0.3)[1]:extrude(0.05):trim_to(slope, { horizontal = true, angle = 40 })
print(if tiles then tiles:is_solid() else false)
