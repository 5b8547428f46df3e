-- A stem that is thinner above.
local stem = lsystem({ object = turtle() })
stem:axiom(Width(0.3), F(1), Width(0.15), F(1))
stem:derive()
