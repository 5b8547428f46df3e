--!strict
-- A shop sign: raised letters on a board, and a number that is cut out of a plate.
local name = param("name", { default = "Bäckerei Ámon & Söhne", doc = "Name of the shop." })
local Board, Plate = module("Board", "letters"), module("Plate", "digits")
local sign = lsystem({ object = extruder({ color = "#3c4a3f" }) })
sign:axiom(
  Board(text(name, { size = 0.4, align = "center", spacing = 0.02 })),
  Plate(text("17", { size = 0.5, align = "center" }))
)
-- A face over letters, with a margin (m) around them.
local function behind(letters: Shape, margin: number): Shape
  local size, low = letters:size(), letters:position()
  local face = rectangle(size.x + 2 * margin, size.y + 2 * margin)
  return face:translate(low - vec(margin, margin, 0))
end
local function upright(s: Shape): Shape
  return s:rotate(90, vec(1, 0, 0))
end
sign:rule("Board(letters)", function(this, letters: Shape)
  local board = behind(letters, 0.25)
  local frame = board:molding({ { 0, -0.06 }, { 0.06, -0.06 }, { 0.06, 0.05 }, { 0, 0.03 } })
  local raised = letters:extrude(0.04):color("#e8c46a")
  local all = shape({ board:extrude(-0.06), frame:color("#8a6a2f"), raised })
  return Draw(all:align():rotate(90, vec(1, 0, 0)))
end)
sign:rule("Plate(digits)", function(this, digits: Shape)
  local plate = behind(digits, 0.12):extrude(0.02)
  local cut = plate:subtract(digits:translate(vec(0, 0, -0.01)):extrude(0.04))
  return Draw(upright((cut or plate):color("#c9ccce")):translate(vec(0, -0.02, -1.4)))
end)
sign:derive()
