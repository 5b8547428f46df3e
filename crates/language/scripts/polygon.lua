-- A yard with a pond as a hole.
local yard = polygon({
  { { 0, 0 }, { 20, 0 }, { 20, 10 }, { 0, 10 } },
  { { 4, 4 }, { 8, 4 }, { 8, 8 }, { 4, 8 } },
})
print(yard:area())
