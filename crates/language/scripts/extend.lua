-- Footprints with a method that tests for large plans.
extend(footprint, {
  reads = {
    is_large = function(self)
      return self:area() > 50
    end,
  },
})
local plan = footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } })
print(plan:is_large())
