-- Solids of each form, the first obstacle on a line, and the nearest surface with its normal.
local post = lsystem({ object = extruder({ sides = 8 }) })
post:axiom(Extrude(3))
local plan = polygon({ 0, 6 }, { 8, 6 }, { 8, 9 }, { 0, 9 })
local yard = obstacles():box({ -6, -1, 0 }, { -5, 5, 2 }):prism(plan, 4):mesh(post:derive(0), { 4, 0, 0 })
print(yard:count(), yard:distance({ 0, 0, 1 }), yard:contains({ 2, 7, 1 }))
print(yard:nearest({ 0, 0, 1 }), yard:normal({ -4, 0, 1 }))
local share = yard:hit({ 0, 0, 1 }, { 0, 8, 1 })
print(share) -- 0.75
