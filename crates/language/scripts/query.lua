-- The houses of more than 10 m, in descending order of height.
source({
  { id = "inn", geometry = point(0, 0), height = 9 },
  { id = "hall", geometry = point(20, 0), height = 14 },
  { id = "church", geometry = point(40, 0), height = 31 },
}, { table = "houses" })
local sql = "SELECT id, height FROM houses WHERE height > $least ORDER BY height DESC"
for _, house in query(sql, { least = 10 }) do
  print(house.id, house.height)
end
