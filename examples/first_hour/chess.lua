--!strict
-- A game of chess: each derivation step is a move, and the pieces come from a lathe.
local played = param("moves", { default = 6, min = 0, max = 6, step = 1, doc = "Number of moves" })
local light = param("light", { default = "#ead9b5", doc = "Colour of the white pieces" })
local dark = param("dark", { default = "#3b2a24", doc = "Colour of the black pieces" })

-- Points { height (m), radius (m) } of each kind above a foot that all kinds share.
local foot = { { 0, 0.38 }, { 0.08, 0.38 }, { 0.14, 0.34 }, { 0.2, 0.36 }, { 0.3, 0.26 } }
local bodies: { [string]: { { number } } } = {
  P = { { 0.5, 0.14 }, { 0.66, 0.12 }, { 0.69, 0.22 }, { 0.74, 0.1 } },
  R = { { 0.55, 0.21 }, { 0.78, 0.2 }, { 0.84, 0.29 }, { 0.98, 0.29 } },
  N = { { 0.38, 0.28 }, { 0.44, 0.24 } },
  B = { { 0.55, 0.16 }, { 0.85, 0.12 }, { 0.88, 0.23 }, { 0.94, 0.12 }, { 1.12, 0.2 }, { 1.36, 0.05 } },
  Q = { { 0.65, 0.17 }, { 1.12, 0.14 }, { 1.15, 0.26 }, { 1.22, 0.15 }, { 1.5, 0.27 }, { 1.54, 0.17 } },
  K = { { 0.65, 0.19 }, { 1.22, 0.15 }, { 1.26, 0.27 }, { 1.34, 0.16 }, { 1.62, 0.25 }, { 1.72, 0.1 } },
}
local horse = curve({
  points = {
    { -0.22, 0 },
    { 0.2, 0 },
    { 0.2, 0.2 },
    { 0.1, 0.36 },
    { 0.26, 0.36 },
    { 0.36, 0.42 },
    { 0.34, 0.54 },
    { 0.18, 0.74 },
    { 0.1, 0.9 },
    { 0.02, 0.94 },
    { -0.04, 0.82 },
    { -0.2, 0.62 },
    { -0.27, 0.3 },
  },
  kind = "through",
  closed = true,
})

local Turned, Top = module("Turned", "kind"), module("Top", "kind")
local function piece(kind: string, color: Color): Model
  local system = lsystem({ object = extruder({ sides = 40, color = color, roughness = 0.3 }) })
  system:axiom(Turned(kind), Top(kind))
  system:interpret("Turned(kind)", function(this, kind)
    local points = table.clone(foot)
    for _, place in bodies[kind] do
      table.insert(points, place)
    end
    local profile, height = ramp(points), points[#points][1]
    for number = 1, 50 do
      this:scale(profile:at((number - 1) / 50 * height)):taper(profile:at(number / 50 * height))
      this:extrude(height / 50)
    end
  end)
  system:interpret("Top(kind)", function(this, kind)
    local function bead(radius: number, up: number)
      this:shape(ball(radius, 24):translate(vec(0, 0, up)):smooth())
    end
    if kind == "P" then
      bead(0.19, 0.12)
    elseif kind == "B" then
      bead(0.07, 0.04)
    elseif kind == "K" then
      this:shape(cuboid(0.07, 0.07, 0.26):translate(vec(-0.035, -0.035, -0.02)))
      this:shape(cuboid(0.2, 0.07, 0.07):translate(vec(-0.1, -0.035, 0.1)))
    elseif kind == "N" then
      local outline = {}
      for number = 1, 60 do
        outline[number] = horse:point(number / 60) - vec(0, 0.06, 0)
      end
      this:direction({ 1, 0, 0 }, { 0, 0, 1 }):polygon(outline):advance(-0.14)
      this:scale(0.8):taper(1):extrude(0.07):extrude(0.14):taper(0.8):extrude(0.07)
    else
      local teeth = if kind == "Q" then 9 else 6
      bead(if kind == "Q" then 0.15 else 0.01, 0)
      for number = 1, teeth do
        local turn = 2 * math.pi * number / teeth
        local at = vec(math.cos(turn), math.sin(turn), 0) * (if kind == "Q" then 0.24 else 0.23)
        if kind == "Q" then
          this:shape(ball(0.05, 16):translate(at - vec(0, 0, 0.02)):smooth())
        else
          this:shape(cuboid(0.1, 0.13, 0.12):translate(at - vec(0.05, 0.065, 0)):rotate(math.deg(turn)))
        end
      end
    end
  end)
  return system:derive(0)
end

local Board, Piece = module("Board"), module("Piece", "kind", "is_white", "square")
local models: { [boolean]: { [string]: Model } } = { [true] = {}, [false] = {} }
for _, kind in { "P", "R", "N", "B", "Q", "K" } do
  models[true][kind], models[false][kind] = piece(kind, light), piece(kind, dark)
end
local chain: { any } = { Board() }
for column, kind in { "R", "N", "B", "Q", "K", "B", "N", "R" } do
  local letter = ("abcdefgh"):sub(column, column)
  for _, row in { 1, 2, 7, 8 } do
    table.insert(chain, { Piece(if row == 2 or row == 7 then "P" else kind, row < 4, letter .. row) })
  end
end

-- A move is { from, to }; a piece that stands at `to` is taken.
local moves =
  { { "e2", "e4" }, { "e7", "e5" }, { "g1", "f3" }, { "d7", "d6" }, { "d2", "d4" }, { "e5", "d4" } }
local game = lsystem({ object = extruder({ roughness = 0.4 }) })
game:axiom(sequence(chain))
game:rule("Piece(kind, is_white, square)", {
  when = function(this, kind, is_white, square)
    return moves[step()][1] == square
  end,
}, function(this, kind, is_white)
  return Piece(kind, is_white, moves[step()][2])
end)
game:rule("Piece(kind, is_white, square)", {
  when = function(this, kind, is_white, square)
    return moves[step()][2] == square
  end,
}, function(this)
  return nil
end)
game:interpret("Piece(kind, is_white, square)", function(this, kind, is_white, square)
  local x, y = square:byte(1) - 96, square:byte(2) - 48
  this:jump({ x, y, 0 }):roll(if is_white then 110 else -60):place(models[is_white][kind])
end)
game:interpret("Board", function(this)
  for x, column in rectangle(8, 8):split("x", { "1*" }) do
    for y, square in column:split("y", { "1*" }) do
      local color = if (x + y) % 2 == 0 then "#7d5235" else "#dfc89a"
      this:shape(square:translate(vec(0.5, 0.5, 0)):extrude(-0.1), color)
    end
  end
  local frame = shape({
    { { 0, 0 }, { 9, 0 }, { 9, 9 }, { 0, 9 } },
    { { 0.5, 0.5 }, { 8.5, 0.5 }, { 8.5, 8.5 }, { 0.5, 8.5 } },
  })
  this:shape(frame:extrude(-0.2), "#5a3826")
end)
game:derive(played)
camera({ name = "player", from = { 0.6, -6.4, 6.2 }, to = { 4.9, 4, -0.3 }, fov = 42 })
