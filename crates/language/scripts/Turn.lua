-- Three branches: left by the turtle's own angle, then left and right by other angles.
local fan = lsystem({ object = turtle({ angle = 30 }) })
fan:axiom({ Turn(), F(1) }, { Left(60), F(1) }, { Right(45), F(1) })
fan:derive()
