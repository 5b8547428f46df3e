-- A custom object type: a lamp that draws itself.
local lamp = object("lamp", {
  doc = "A street lamp.",
  extends = extruder,
  fields = { height = { default = 4, min = 1, unit = "m", doc = "From the ground to the light." } },
  changes = {
    stand = function(self)
      return self:scale(0.06):extrude(self.height)
    end,
  },
})
local Lamp = module("Lamp")
local street = lsystem({ object = lamp({ height = 5 }) })
street:axiom(Lamp())
street:interpret("Lamp", function(this)
  this:stand()
end)
street:derive()
