--!strict
-- Materials with images of this package. Other packages can replace the images or this file.
local tint = param("stone", { default = "#fff3dc", doc = "tint of the masonry" })

local function stone(color)
  return {
    color = color,
    texture = "@masonry/textures/ashlar.png",
    texture_size = { 3.2, 3.2 },
    roughness = 0.95,
    name = "ashlar",
  }
end

return {
  ashlar = stone(tint),
  -- Sills, string courses and corbels: the same stone, freshly dressed.
  dressed = stone(mix(tint, "#ffffff", 0.45)),
  -- Stone near the ground, darkened by the weather.
  footing = stone(mix(tint, "#6b6a58", 0.4)),
  slate = {
    color = "#d5d8de",
    texture = "@masonry/textures/slate.png",
    texture_size = { 2.4, 2.4 },
    roughness = 0.55,
    name = "slate",
  },
  oak = {
    color = "#b98a5a",
    texture = "@masonry/textures/oak.png",
    texture_size = { 1.6, 1.6 },
    roughness = 0.8,
    name = "oak",
  },
  void = { color = "#17181b", roughness = 0.4, name = "void" },
  iron = { color = "#2c2b2b", roughness = 0.45, metallic = 0.8, name = "iron" },
}
