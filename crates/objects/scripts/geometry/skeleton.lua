-- The straight skeleton of a plan, the faces between its lines, and the plan inset by 1 m.
local plan = polygon({ 0, 0 }, { 12, 0 }, { 12, 8 }, { 0, 8 })
print(plan:straight_skeleton():length(), #plan:skeleton_faces(), plan:inset(1):area())
