-- The attributes of each house of a source.
local houses = source({ { id = "inn", geometry = point(3, 4), height = 6 } })
for _, feature in houses do
  print(feature.id, feature.layer, feature.height, feature.geometry:x())
end
