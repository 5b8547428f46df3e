-- The size of a model: its bounding box.
local window = model("window.glb")
print(window:high() - window:low())
