-- All notations of a colour.
local bars = lsystem({ object = turtle() })
bars:axiom(Color("#a8553a"), F(1), Color("lightblue"), F(1), Color({ 0.3, 0.6, 0.2 }), F(1))
bars:derive()
