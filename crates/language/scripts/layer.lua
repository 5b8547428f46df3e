-- A list of features: the number, the first one, and the ids.
local houses = source({ { id = "inn", geometry = point(3, 4) }, { id = "barn", geometry = point(9, 7) } })
print(#houses, houses.features[1].id)
for index, feature in houses do
  print(index, feature.id)
end
