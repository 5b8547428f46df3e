-- Colours of a palette, by number.
local rod = lsystem({ object = turtle({ palette = { "#a8553a", "#e8e4d8", "#336699" } }) })
rod:axiom(Paint(1), F(1), Paint(2), F(1), Paint(3), F(1))
rod:derive()
