-- Obstacles of three forms, the first one on a line, and the nearest surface with its normal.
local plan = polygon({ 0, 6 }, { 8, 6 }, { 8, 9 }, { 0, 9 })
local yard = obstacles():box({ -6, -1, 0 }, { -5, 5, 2 }):prism(plan, 4):sphere({ 4, 0, 1 }, 1)
print(yard:count(), yard:distance({ 0, 0, 1 }), yard:contains({ 2, 7, 1 }))
print(yard:nearest({ 0, 0, 1 }), yard:normal({ -4, 0, 1 }))
print(yard:hit({ 0, 0, 1 }, { 0, 8, 1 })) -- 0.75
