-- A geometry from well-known text, with its measures.
local yard = geometry("POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))")
print(yard:area(), yard:length())
