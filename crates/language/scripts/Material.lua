-- A stem of polished metal.
local stem = lsystem({ object = turtle() })
stem:axiom(Material({ color = "#b08d57", metallic = 1, roughness = 0.2 }), F(2))
stem:derive()
