-- Letters of a sign, and their number and sizes.
local sign = text("Bakery", { size = 0.4, align = "center", spacing = 0.02 })
print(sign:face_count(), sign:faces("tag:text.1")[1]:area(), sign:extrude(0.05):is_solid())
print(text("HOUSE\n12", { line_height = 1.6 }):size())
