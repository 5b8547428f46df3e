-- The common part of two wings of a house, and the parts of only one wing.
local long = polygon({ 0, 0 }, { 20, 0 }, { 20, 8 }, { 0, 8 })
local wide = polygon({ 12, 0 }, { 20, 0 }, { 20, 16 }, { 12, 16 })
print(long:union(wide):area(), long:intersection(wide):area(), long:sym_difference(wide):area())
