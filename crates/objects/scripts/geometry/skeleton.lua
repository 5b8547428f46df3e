-- The ridges over a ground plan, the faces between them, and the plan moved inwards by 1 m.
local plan = polygon({ 0, 0 }, { 12, 0 }, { 12, 8 }, { 0, 8 })
print(plan:straight_skeleton():length(), #plan:skeleton_faces(), plan:inset(1):area())
