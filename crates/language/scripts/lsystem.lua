-- The Koch curve: the turtle of the system draws each F.
local curve = lsystem({ object = turtle({ step = 0.1, width = 0.05 }) })
curve:axiom(F())
curve:rule("F", function()
  return F(), Left(60), F(), Right(120), F(), Left(60), F()
end)
curve:derive(3)
