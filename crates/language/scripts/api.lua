-- A script that works without a function of a later API version.
print(api.version)
if api.has("terrain") then
  print("there is ground")
end
