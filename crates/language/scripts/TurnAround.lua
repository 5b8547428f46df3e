-- Forward, and back next to the first line.
local hairpin = lsystem({ object = turtle() })
hairpin:axiom(F(2), Turn(90), F(0.3), Turn(-90), TurnAround(), F(1))
hairpin:derive()
