-- A well-known text as a geometry, which can be measured.
local yard = geometry("POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))")
print(yard:area(), yard:length())
