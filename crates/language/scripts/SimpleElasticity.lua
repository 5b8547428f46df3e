-- The symbol _ of cpfg: the heading tilts more and more upwards.
local twigs = lsystem({ object = turtle({ angle = 70, simple_increment = 0.03 }) })
twigs:axiom("[-_(0.1)FFFFFF][+_F_F_F_F_F_F]")
twigs:derive()
