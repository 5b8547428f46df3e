-- A script that goes on without what an earlier version lacks.
print(api.version)
if api.has("terrain") then
  print("there is ground")
end
