-- A self-crossing ring, the reason, and the two valid areas.
local bow = geometry("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")
print(bow:is_valid(), bow:validity(), bow:make_valid():wkt())
