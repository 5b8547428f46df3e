-- A ring that crosses itself, why it is wrong, and the two areas that it was meant to be.
local bow = geometry("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")
print(bow:is_valid(), bow:validity(), bow:make_valid():wkt())
