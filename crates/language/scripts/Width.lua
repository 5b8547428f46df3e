-- A stem with a thinner upper part.
local stem = lsystem({ object = turtle() })
stem:axiom(Width(0.3), F(1), Width(0.15), F(1))
stem:derive()
