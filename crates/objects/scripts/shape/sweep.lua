-- A handrail along a list of positions, a frame, a beam along a ridge, and a twisted column.
local rail = disk(0.04, 12):sweep({ vec(0, 0, 1), vec(3, 0, 1), vec(5, 0, 2.2), vec(5, 3, 2.2) })
print(rail:is_solid(), rail:faces("tag:sweep.end")[1]:center())
local section = shape({ { 0, 0 }, { 0.1, 0 }, { 0.1, 0.04 }, { 0.03, 0.08 }, { 0, 0.08 } })
local corners = { vec(0, 0, 0), vec(2, 0, 0), vec(2, 1, 0), vec(0, 1, 0) }
print(
  section:sweep(corners, { closed = true }):volume(),
  section:sweep(corners, { joint = "smooth" }):is_solid()
)
local ridge = rectangle(12, 8):roof({ kind = "hip", height = 3 }):edges("ridge")[1]
print(section:sweep(ridge):size())
print(
  section:sweep(curve({ vec(0, 0, 0), vec(1, 0, 2), vec(0, 0, 4) }), { twist = 180, scale = 0.5 }):volume()
)
