-- A red stem with a green tip.
local stem = lsystem({ object = turtle() })
stem:axiom(Color("#a8553a"), F(2), Color("#5b8a3a"), F(0.5))
stem:derive()
