-- The plan below a roof, right angles of a measured plan, convex faces, and points in a ball.
local roof = rectangle(12, 8):roof({ kind = "hip", height = 3, overhang = 0.5 })
local plan = roof:ground_plan(0)
print(if plan then plan:area() else 0)
local measured = shape({ { 0, 0.1 }, { 8, -0.1 }, { 8.1, 3 }, { 4, 3.1 }, { 3.9, 6 }, { 0.1, 6.1 } }):align()
print(measured:rectify(10):points(), measured:convexify():face_count())
print(ball(1, 64):reduce(0.2):volume())
print(#ball(1):scatter(20, { within = "volume", seed = 3 }), #ball(1):scatter(5, { within = "scope" }))
