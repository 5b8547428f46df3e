--!strict
-- A box, in one line.
lsystem({ object = extruder({ sides = 4, smooth = false, color = "#c8553d" }) })
  :axiom(F(1.4))
  :interpret("F(height)", function(this, height)
    this:extrude(height)
  end)
  :derive()
