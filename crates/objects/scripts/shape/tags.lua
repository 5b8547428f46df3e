-- Tags of faces, which later operations select by.
local mass = rectangle(8, 6):tag("plan"):extrude(3):color("tan")
print(table.concat(mass:tags(), " "), mass:untag("plan"):has_tag("extrude.*"))
print(#mass:faces("tag:extrude.side"), mass:recompose():face_count())
