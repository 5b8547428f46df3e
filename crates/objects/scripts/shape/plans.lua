-- A lot: the part that can be built on, strips along its edges, wings, and an envelope.
local lot = rectangle(30, 20)
print(#lot:offset(-2), lot:setback({ front = 5, side = 3 })[1]:area(), #lot:border(4))
print(lot:wings({ front = 8, left = 6 })[1]:area(), lot:setback_to_area(300)[1]:size())
print(lot:envelope(20, { front = { 9, 60 } }):volume())
local angle = shape({ { 0, 0 }, { 20, 0 }, { 20, 8 }, { 8, 8 }, { 8, 20 }, { 0, 20 } })
local inner = angle:inner_rectangle()
print(if inner then inner:size() else nil, #angle:scatter(10, { seed = 3 }))
