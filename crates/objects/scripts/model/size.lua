-- How large a model is: one box around all of it.
local window = model("window.glb")
print(window:high() - window:low())
