-- The keywords and attributes of a footprint.
local shape = { { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }
local plan = footprint(shape, { keywords = { "shop" }, attributes = { name = "Inn" } })
print(plan:has("shop"), plan:attribute("name"))
