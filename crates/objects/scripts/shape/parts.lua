-- Storeys of a tower, their numbers, and the parts of a lot by area.
local tower = cuboid(12, 12, 20):with("style", "brick")
for _, storey in tower:split("z", { 4, "~3*", "10%" }) do
  print(storey:index(), storey:count(), storey:entry(), storey:get("style"), storey:size().z)
end
local lot = shape({ { 0, 0 }, { 30, 0 }, { 30, 12 }, { 12, 20 }, { 0, 20 } })
print(#lot:split_area("x", { "~120*" }), #rectangle(20, 30):split_area("y", { 200, "~1" }))
