-- Enclosing shapes of an irregular plan: an axis-aligned rectangle, a rotated rectangle, and the convex hull.
local plan = polygon({ 0, 0 }, { 8, 2 }, { 5, 4 }, { 7, 9 })
print(plan:envelope(), plan:oriented_envelope(), plan:convex_hull())
