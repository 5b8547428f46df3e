-- Reports a value that gives a poor model: --strict treats the warning as an error.
local trees = param("trees", { default = 12, min = 0, max = 50, step = 1 })
if trees < 3 then
  warn(`{trees} trees make no forest`, "plant more: --set trees=30")
end
