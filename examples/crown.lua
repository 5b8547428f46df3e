--!strict
-- A tree whose form is drawn: the crown, the taper of the trunk and its cross-section are curves in the live view.
-- burgeon live examples/crown.lua
local height = param("height", { default = 9, min = 3, max = 20, step = 0.5, unit = "m" })
local crown = param("crown", {
  default = ramp({ { 0.12, 0 }, { 0.3, 2.9 }, { 0.65, 2.2 }, { 1, 0.2 } }),
  doc = "Length of the branches (m) by their height, from 0 at the ground to 1 at the top.",
})
local taper = param("taper", {
  default = ramp({ { 0, 0.75 }, { 0.1, 0.45 }, { 0.6, 0.26 }, { 1, 0.03 } }),
  doc = "Width of the trunk (m) by the height.",
})
local rise = param("rise", {
  default = ramp({ { 0, 85 }, { 0.5, 62 }, { 1, 25 } }, { kind = "linear" }),
  doc = "Angle between branches and trunk (degrees) by the height.",
})
local section = param("section", {
  default = curve({
    points = {
      { 1, 0 },
      { 0.35, 0.35 },
      { 0, 1 },
      { -0.35, 0.35 },
      { -1, 0 },
      { -0.35, -0.35 },
      { 0, -1 },
      { 0.35, -0.35 },
    },
    closed = true,
  }),
  doc = "Cross-section of the trunk.",
})

local PARTS = 28
local Base, Trunk, Top = module("Base"), module("Trunk", "number"), module("Top")
local Branch, Leaf = module("Branch", "length", "width"), module("Leaf", "size")
local tree = lsystem({ object = turtle({ sides = 14, color = "#7d6650", roughness = 0.9 }) })
tree:axiom(Base(), Trunk(1))
tree:rule("Trunk(number)", function(_, number: number)
  if number > PARTS then
    return Top()
  end
  local h = number / PARTS
  local length = crown:at(h)
  local next = Trunk(number + 1)
  if length < 0.05 then
    return Roll(137.5), F(height / PARTS), next
  end
  local branch = { Pitch(rise:at(h)), Branch(length, 0.3 * taper:at(h)) }
  return Width(taper:at(h)), F(height / PARTS), branch, Roll(137.5), next
end)
tree:rule("Branch(length, width)", function(_, length: number, width: number)
  if length < 0.4 then
    return Leaf(0.26)
  end
  local side = { Turn(38), Branch(length * 0.45, width * 0.6) }
  local other = { Turn(-38), Branch(length * 0.45, width * 0.6) }
  return Width(width), F(length * 0.35), side, other, Pitch(-4), Branch(length * 0.6, width * 0.75)
end)
tree:interpret("Base", function(this)
  this:width(taper:at(0)):contour(section):begin_cylinder()
end)
tree:interpret("Top", function(this)
  this:width(0):forward(0.2):end_cylinder()
end)
tree:interpret("Leaf(size)", function(this, size)
  this:color("#5c8f3a"):sphere(size)
end)
tree:derive()
