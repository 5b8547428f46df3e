-- The ground of a file: its box, how fine it is, and the height in the middle of it.
local ground = elevation("ground.asc")
print(ground:low(), ground:high(), ground:step())
print(ground:height(lerp(ground:low(), ground:high(), 0.5)))
