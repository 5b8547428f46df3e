-- The elevation of a file: its box, its resolution, and the height at its centre.
local ground = elevation("ground.asc")
print(ground:low(), ground:high(), ground:step())
print(ground:height(lerp(ground:low(), ground:high(), 0.5)))
