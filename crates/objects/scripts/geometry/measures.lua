-- The measures of a plan, and its distance from a well.
local plan, well = polygon({ 0, 0 }, { 20, 0 }, { 20, 8 }, { 0, 8 }), point(30, 4, 1)
print(plan:area(), plan:perimeter(), plan:length(), plan:num_points())
print(plan:envelope_width(), plan:envelope_height(), plan:distance(well), plan:nearest_point(well):wkt())
print(well:x(), well:y(), well:z(), well:place())
