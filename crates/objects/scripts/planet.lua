local hills = { A = { "A", "A", "A", "A", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }
local globe = lsystem({ object = planet({ radius = 1738000, levels = 6, rules = hills }) })
globe:derive()
