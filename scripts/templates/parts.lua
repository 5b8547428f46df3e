--!strict
-- Models on walls and roofs: windows, doors, shop fronts, balconies, dormers, chimneys. All are seen from the front:
-- x to the right, z up, y into the wall; y = 0 is the surface. By default their centre is x = 0, and their bottom is
-- z = 0. Lengths are in metres.
local pieces = require("templates/shapes")

local fine = param("fine", {
  default = true,
  doc = "Whether windows, railings and shutters have all their pieces; a city of thousands of buildings needs few",
})
-- The table of parts includes the shapes and materials.
local parts: { [string]: (...any) -> any } = table.clone(pieces)
local box, plate, model = parts.box, parts.plate, parts.model

type Material = { [string]: any }
type Piece = { [string]: any }

-- The pieces of a casement: a frame, `columns` by `rows` panes and glass. Its front is at the depth `y`.
local function casement(o: any): { Piece }
  local w, h, f, y = o.width / 2, o.height, o.frame or 0.07, o.y or 0
  local low, x0 = o.low or 0, o.x or 0
  local bar = o.bar or 0.035
  local frame, glass = o.material, o.glass or parts.glass
  local columns, rows = o.columns or 2, o.rows or 1
  if not fine then
    -- Panes in front of a plate in the frame's colour.
    local shapes = { box(frame, x0 - w, x0 + w, y + 0.02, y + 0.06, low, low + h) }
    local panes = math.min(columns, 2)
    for pane = 1, panes do
      local from, to = x0 + w * (2 * (pane - 1) / panes - 1), x0 + w * (2 * pane / panes - 1)
      table.insert(shapes, box(glass, from + f, to - f, y, y + 0.03, low + f, low + h - f))
    end
    return shapes
  end
  local shapes = {
    box(frame, x0 - w, x0 - w + f, y, y + 0.08, low, low + h),
    box(frame, x0 + w - f, x0 + w, y, y + 0.08, low, low + h),
    box(frame, x0 - w + f, x0 + w - f, y, y + 0.08, low, low + f),
    box(frame, x0 - w + f, x0 + w - f, y, y + 0.08, low + h - f, low + h),
    box(glass, x0 - w + f, x0 + w - f, y + 0.05, y + 0.07, low + f, low + h - f),
  }
  for column = 1, columns - 1 do
    local x = x0 - w + 2 * w * column / columns
    -- The bar between two wings is as wide as two frames.
    local thick = if columns % 2 == 0 and column == columns / 2 then f * 0.7 else bar / 2
    table.insert(shapes, box(frame, x - thick, x + thick, y + 0.005, y + 0.06, low + f, low + h - f))
  end
  for row = 1, rows - 1 do
    local z = low + h * row / rows
    table.insert(shapes, box(frame, x0 - w + f, x0 + w - f, y + 0.02, y + 0.06, z - bar / 2, z + bar / 2))
  end
  return shapes
end
parts.casement = casement

-- A window that fills an opening: { width, height, color, columns, rows, frame, glass }.
function parts.window(o)
  o = table.clone(o)
  o.material = parts.painted(o.color or "#e9e6de")
  return model(casement(o))
end

-- A sash window, the upper half in front of the lower one.
function parts.sash(o: any)
  local paint = parts.painted(o.color or "#eeece6")
  local half =
    { width = o.width, height = o.height / 2, material = paint, columns = o.columns or 2, bar = 0.03 }
  half.rows, half.frame = o.rows or 1, 0.06
  local upper = table.clone(half)
  upper.low, half.y = o.height / 2 - 0.02, 0.06
  upper.height = o.height / 2 + 0.02
  return model(casement(half), casement(upper))
end

-- The surround of an opening of the given size, projecting from the wall: jambs, and a lintel as high as the part
-- below the sill, so that its centre is the centre of the opening. { width, height, jamb, head, sill, out, color,
-- material }
function parts.surround(o: any)
  local w, h, head = o.width / 2, o.height, o.head or 0.16
  local jamb, out, stone = o.jamb or 0, o.out or 0.05, o.material or parts.matt(o.color or "#d9cfba")
  local wide = w + jamb + (o.ears or 0)
  local shapes = {
    box(stone, -wide, wide, -out, 0.02, h, h + head),
    -- Below the sill it is stepped, for a shadow.
    box(stone, -wide - 0.03, wide + 0.03, -out - 0.09, 0.02, -head * 0.55, 0),
  }
  if fine then
    table.insert(shapes, box(stone, -wide, wide, -out, 0.02, -head, -head * 0.55))
  end
  if jamb > 0 then
    table.insert(shapes, box(stone, -w - jamb, -w, -out, 0.02, 0, h))
    table.insert(shapes, box(stone, w, w + jamb, -out, 0.02, 0, h))
  end
  if o.keystone then
    table.insert(
      shapes,
      plate(stone, {
        { -0.09, h - 0.06 },
        { 0.09, h - 0.06 },
        { 0.14, h + head },
        { -0.14, h + head },
      }, -out - 0.07, 0)
    )
  end
  if o.shutters then
    local leaf = w * 0.98
    for side = -1, 1, 2 do
      local x = side * (w + jamb + leaf / 2 + 0.03)
      for _, piece in parts.shutter(x, leaf, h, o.shutters) do
        table.insert(shapes, piece)
      end
    end
  end
  if o.pots then
    table.insert(shapes, box(parts.clay, -w * 0.8, w * 0.8, -out - 0.2, -out, 0, 0.17))
    table.insert(shapes, box(parts.matt(o.pots), -w * 0.85, w * 0.85, -out - 0.24, -out + 0.02, 0.17, 0.36))
    table.insert(shapes, box(parts.matt("#4e6b35"), -w * 0.8, w * 0.8, -out - 0.27, -out + 0.02, 0.12, 0.22))
  end
  return model(shapes)
end

-- The surround of a door, projecting from the wall: jambs and a lintel. { width, height, jamb, head, out, material }
function parts.portal(o: any)
  local w, h, jamb, head, out = o.width / 2, o.height, o.jamb, o.head, o.out or 0.05
  local shapes = {
    box(o.material, -w - jamb, -w, -out, 0.02, 0, h),
    box(o.material, w, w + jamb, -out, 0.02, 0, h),
    box(o.material, -w - jamb, w + jamb, -out, 0.02, h, h + head * 0.7),
    box(o.material, -w - jamb - 0.06, w + jamb + 0.06, -out - 0.1, 0.02, h + head * 0.7, h + head),
  }
  if o.keystone then
    table.insert(
      shapes,
      plate(o.material, {
        { -0.13, h - 0.1 },
        { 0.13, h - 0.1 },
        { 0.2, h + head * 0.7 },
        { -0.2, h + head * 0.7 },
      }, -out - 0.07, 0)
    )
  end
  return model(shapes)
end

-- An open shutter with slats, centred on x, folded back on the wall.
function parts.shutter(x: number, width: number, height: number, color): { Piece }
  local paint, x0, x1 = parts.painted(color), x - width / 2, x + width / 2
  if not fine then
    return { box(paint, x0, x1, -0.04, 0, 0, height) }
  end
  local shapes = {
    box(paint, x0, x0 + 0.06, -0.05, 0, 0, height),
    box(paint, x1 - 0.06, x1, -0.05, 0, 0, height),
    box(paint, x0 + 0.06, x1 - 0.06, -0.025, 0, 0, height),
  }
  for _, z in { 0, height / 2 - 0.04, height - 0.08 } do
    table.insert(shapes, box(paint, x0 + 0.06, x1 - 0.06, -0.05, -0.02, z, z + 0.08))
  end
  local slats = math.floor(height / 0.14)
  for slat = 1, slats - 1 do
    local z = height * slat / slats
    table.insert(shapes, box(paint, x0 + 0.06, x1 - 0.06, -0.042, -0.02, z - 0.025, z + 0.025))
  end
  return shapes
end

-- An iron railing between x0 and x1 at the depth y, from z0 up to z1.
local function railing(
  x0: number,
  x1: number,
  y: number,
  z0: number,
  z1: number,
  step: number?,
  material: Material?
): { Piece }
  local iron = material or parts.iron
  local shapes = {
    box(iron, x0, x1, y - 0.03, y + 0.03, z1 - 0.04, z1),
    box(iron, x0, x1, y - 0.02, y + 0.02, z0 + 0.05, z0 + 0.08),
  }
  if fine then
    table.insert(shapes, box(iron, x0, x1, y - 0.012, y + 0.012, z1 - 0.2, z1 - 0.18))
  end
  local count = math.max(1, math.floor((x1 - x0) / (if fine then step or 0.13 else 0.5)))
  for index = 0, count do
    local x = lerp(x0 + 0.012, x1 - 0.012, index / count)
    table.insert(shapes, box(iron, x - 0.01, x + 0.01, y - 0.01, y + 0.01, z0, z1 - 0.04))
  end
  return shapes
end
parts.railing = railing :: any

-- An iron railing perpendicular to the wall at x, from the depth y0 to the wall.
local function side_railing(x: number, y0: number, z0: number, z1: number, material: Material?): { Piece }
  local iron = material or parts.iron
  local shapes = {
    box(iron, x - 0.03, x + 0.03, y0, 0, z1 - 0.04, z1),
    box(iron, x - 0.02, x + 0.02, y0, 0, z0 + 0.05, z0 + 0.08),
  }
  local count = math.max(1, math.floor(-y0 / (if fine then 0.13 else 1)))
  for index = 0, count - 1 do
    local y = y0 * (1 - index / count)
    table.insert(shapes, box(iron, x - 0.01, x + 0.01, y, y + 0.02, z0, z1 - 0.04))
  end
  return shapes
end

-- An iron balcony in front of an opening of the given size: a slab on brackets, a railing, and mouldings above the
-- opening of the height of the slab. { width, height, depth, side, slab, material, stone, rail }
function parts.balcony(o: any)
  local w, d, slab = o.width / 2 + (o.side or 0.3), o.depth or 0.6, o.slab or 0.16
  local stone = o.material or parts.matt("#cfc6b4")
  local shapes = {
    box(stone, -w, w, -d, 0.02, -slab, 0),
    box(stone, -w - 0.04, w + 0.04, -d - 0.04, 0.02, -slab * 0.4, -0.01),
    box(stone, -w, w, -0.09, 0.02, o.height, o.height + slab),
  }
  for side = -1, 1, 2 do
    local x = side * (w - 0.18)
    if not o.plain then
      table.insert(shapes, box(stone, x - 0.07, x + 0.07, -d * 0.65, 0, -slab + 0.005, -slab + 0.02))
    end
    if (o.jamb or 0) > 0 then
      local a, b = o.width / 2, o.width / 2 + o.jamb
      table.insert(
        shapes,
        box(stone, math.min(side * a, side * b), math.max(side * a, side * b), -0.05, 0.02, 0, o.height)
      )
    end
  end
  local y = -d + 0.05
  return model(
    shapes,
    railing(-w + 0.04, w - 0.04, y, 0, 1.02, o.step, o.rail),
    side_railing(-w + 0.04, y, 0, 1.02, o.rail),
    side_railing(w - 0.04, y, 0, 1.02, o.rail)
  )
end

-- One bay of a continuous balcony along a front, for a bay of about `width` by `height`, with a string course at its
-- top. With `ending` = -1 or 1 it is an end of the balcony, with a railing across.
function parts.gallery(o: any)
  local w, d, slab = o.width / 2, o.depth or 0.6, o.slab or 0.18
  local stone = o.material or parts.matt("#cfc6b4")
  local course = o.course or 0.12
  local shapes = { box(stone, -w, w, -0.07, 0.02, o.height - course, o.height) }
  if o.ending then
    table.insert(shapes, box(stone, -w, w, -0.07, 0.02, 0, slab))
    local inner = -o.ending * w
    table.insert(
      shapes,
      box(stone, math.min(inner, inner * 0.9), math.max(inner, inner * 0.9), -d, 0, 0, slab)
    )
    return model(shapes, side_railing(inner * 0.93, -d + 0.06, slab, slab + 1))
  end
  table.insert(shapes, box(stone, -w, w, -d, 0.02, 0.04, slab))
  table.insert(shapes, box(stone, -w, w, -d * 0.8, 0.02, 0, 0.04))
  for side = -1, 1, 2 do
    local x = side * w * 0.6
    table.insert(shapes, box(stone, x - 0.1, x + 0.1, -d * 0.7, 0, -0.16, 0.02))
    table.insert(shapes, box(stone, x - 0.1, x + 0.1, -d * 0.4, 0, -0.34, -0.16))
  end
  return model(shapes, railing(-w, w, -d + 0.06, slab, slab + 1.0, 0.15))
end

-- A door that fills an opening: { width, height, color, wings, transom, glass }.
function parts.door(o: any)
  local w, h, paint = o.width / 2, o.height, parts.painted(o.color or "#4a3426")
  local transom = o.transom or 0
  local leaf = h - transom
  local shapes = {
    box(paint, -w, -w + 0.07, 0, 0.1, 0, h),
    box(paint, w - 0.07, w, 0, 0.1, 0, h),
    box(paint, -w + 0.07, w - 0.07, 0, 0.1, h - 0.07, h),
    box(paint, -w + 0.07, w - 0.07, 0.04, 0.09, 0, leaf),
  }
  if transom > 0 then
    table.insert(shapes, box(paint, -w + 0.07, w - 0.07, 0, 0.1, leaf, leaf + 0.07))
    table.insert(shapes, box(parts.glass, -w + 0.07, w - 0.07, 0.05, 0.07, leaf + 0.07, h - 0.07))
    table.insert(shapes, box(paint, -0.02, 0.02, 0.02, 0.06, leaf + 0.07, h - 0.07))
  end
  local wings = o.wings or 1
  local inside = 2 * w - 0.14
  for wing = 1, wings do
    local x0, x1 = -w + 0.07 + inside * (wing - 1) / wings + 0.1, -w + 0.07 + inside * wing / wings - 0.1
    local upper = if o.glass then parts.glass else paint
    table.insert(shapes, box(paint, x0, x1, 0.015, 0.05, 0.15, leaf * 0.36))
    table.insert(shapes, box(upper, x0, x1, if o.glass then 0.03 else 0.015, 0.05, leaf * 0.44, leaf - 0.16))
    local handle = if wing == 1 then x1 + 0.04 else x0 - 0.04
    table.insert(shapes, box(parts.steel, handle - 0.02, handle + 0.02, -0.03, 0.04, leaf * 0.42, leaf * 0.5))
  end
  if wings == 2 then
    table.insert(shapes, box(parts.iron, -0.01, 0.01, 0.03, 0.05, 0, leaf))
  end
  return model(shapes)
end

-- A shop front that fills an opening: a wooden frame, a stall riser, display glass, a door and a sign above.
-- { width, height, color, sign, awning }
function parts.shop(o: any)
  local w, h, paint = o.width / 2, o.height, parts.painted(o.color or "#2f4038")
  local sign = h * 0.17
  local top = h - sign
  local door = -w + 1.0
  local shapes = {
    box(paint, -w, w, -0.04, 0.1, top, h),
    box(
      parts.painted(o.sign or "#d8c9a0"),
      -w + 0.25,
      w - 0.25,
      -0.06,
      0,
      top + sign * 0.25,
      h - sign * 0.25
    ),
    box(paint, -w, w, -0.12, 0, h - 0.06, h),
    box(paint, -w, -w + 0.1, 0, 0.1, 0, top),
    box(paint, w - 0.1, w, 0, 0.1, 0, top),
    box(paint, door, door + 0.08, 0, 0.1, 0, top),
    box(paint, door + 0.08, w - 0.1, 0, 0.1, 0, 0.5),
    box(paint, -w + 0.1, door, 0.03, 0.1, 0, 0.3),
    box(paint, -w + 0.1, w - 0.1, 0.01, 0.09, top * 0.76, top * 0.76 + 0.06),
    box(parts.dark_glass, -w + 0.1, w - 0.1, 0.06, 0.09, 0.3, top),
  }
  local panes = math.max(1, math.floor((w - door) / 1.2))
  for pane = 1, panes - 1 do
    local x = lerp(door + 0.04, w - 0.05, pane / panes)
    table.insert(shapes, box(paint, x - 0.025, x + 0.025, 0.01, 0.08, 0.5, top))
  end
  if o.awning then
    local cloth = parts.matt(o.awning)
    -- A slope of cloth, in steps with shadow gaps.
    table.insert(shapes, parts.leaning(cloth, w - 0.05, { 0, top - 0.02 }, { -1.25, top - 0.55 }, 0.04))
    table.insert(shapes, box(cloth, -w + 0.05, w - 0.05, -1.25, -1.22, top - 0.78, top - 0.56))
  end
  return model(shapes)
end

-- A roller gate that fills an opening, with a frame of steel.
function parts.gate(o: any)
  local w, h, metal = o.width / 2, o.height, parts.painted(o.color or "#7d8587")
  local frame = parts.painted(o.frame or "#3d4245")
  local shapes = {
    box(frame, -w, -w + 0.14, -0.03, 0.12, 0, h),
    box(frame, w - 0.14, w, -0.03, 0.12, 0, h),
    box(frame, -w + 0.14, w - 0.14, -0.03, 0.12, h - 0.3, h),
    box(metal, -w + 0.14, w - 0.14, 0.07, 0.1, 0, h - 0.3),
  }
  local slats = if fine then math.floor((h - 0.3) / 0.24) else 0
  for slat = 0, slats - 1 do
    local z = (h - 0.3) * slat / slats
    table.insert(shapes, box(metal, -w + 0.14, w - 0.14, 0.045, 0.08, z + 0.03, z + 0.2))
  end
  return model(shapes)
end

-- A dormer for a roof: a window between cheeks under a small roof. Its front is at y = 0, and its body extends
-- backwards. { width, height, depth, color, roof, kind = "gable" | "curb", window }
function parts.dormer(o: any)
  local w, h, d = o.width / 2, o.height, o.depth or 2
  local wall, roof = parts.matt(o.color or "#d9cfba"), o.roof or parts.zinc
  local opening = { width = o.width - 0.3, height = h - 0.2, low = 0.15, y = -0.03, rows = o.rows or 3 }
  opening.material = parts.painted(o.window or "#e9e6de")
  local shapes = {
    box(wall, -w, w, 0.03, d, -0.8, h),
    box(wall, -w, -w + 0.15, -0.06, 0.04, -0.3, h),
    box(wall, w - 0.15, w, -0.06, 0.04, -0.3, h),
    box(wall, -w - 0.04, w + 0.04, -0.12, 0.04, 0.03, 0.15),
  }
  if o.kind == "gable" then
    local rise = w * (o.slope or 0.8)
    table.insert(shapes, plate(wall, { { -w, h }, { w, h }, { 0, h + rise } }, -0.02, d))
    local e = 0.22
    local drop = rise / w * e
    for side = -1, 1, 2 do
      table.insert(
        shapes,
        plate(roof, {
          { side * (w + e), h - drop },
          { side * (w + e), h - drop + 0.1 },
          { 0, h + rise + 0.12 },
          { 0, h + rise },
        }, -0.25, d + rise)
      )
    end
  else
    table.insert(shapes, box(wall, -w - 0.06, w + 0.06, -0.16, 0.1, h - 0.02, h + 0.1))
    -- A curved cap in four slabs.
    for step = 0, 3 do
      local part = 1 - (step / 4) ^ 2 * 0.85
      local inset = step * 0.02
      table.insert(
        shapes,
        box(
          roof,
          -w * part - 0.04,
          w * part + 0.04,
          -0.12 + inset,
          d,
          h + 0.1 + step * 0.07,
          h + 0.17 + step * 0.07
        )
      )
    end
  end
  return model(shapes, casement(opening))
end

-- A chimney stack with a cap and pots. Its origin is on the roof, and the stack continues down into the roof. x is
-- along the ridge. { width, depth, height, color, material, pots, across }
function parts.chimney(o: any)
  local w, d, h = (o.width or 0.9) / 2, (o.depth or 0.6) / 2, o.height or 1.6
  if o.across then
    w, d = d, w
  end
  local stack = o.material or parts.matt(o.color or "#9b6a54")
  local shapes = {
    box(stack, -w, w, -d, d, -1.6, h),
    box(stack, -w - 0.07, w + 0.07, -d - 0.07, d + 0.07, h - 0.25, h - 0.13),
    box(stack, -w - 0.05, w + 0.05, -d - 0.05, d + 0.05, h - 0.06, h),
  }
  local pots = o.pots or 3
  for pot = 1, pots do
    local part = (pot - 0.5) / pots * 2 - 1
    local x, y = if o.across then 0 else part * w, if o.across then part * d else 0
    table.insert(shapes, box(parts.clay, x - 0.1, x + 0.1, y - 0.1, y + 0.1, h, h + 0.35))
    table.insert(shapes, box(parts.clay, x - 0.12, x + 0.12, y - 0.12, y + 0.12, h + 0.3, h + 0.38))
  end
  return model(shapes)
end

-- The railing of a loggia for a bay of `width` by `height`: panes of glass, or boards if `solid`.
function parts.loggia(o: any)
  local w, h = o.width / 2, o.height
  local frame = o.material or parts.steel
  local pane = if o.solid then parts.matt(o.solid) else parts.clear_glass
  return model({
    box(pane, -w, w, 0.02, 0.05, 0.04, 1.0),
    box(frame, -w, w, 0, 0.07, 1.0, 1.06),
    box(frame, -w, w, 0.01, 0.06, 0, 0.05),
    box(frame, -w, -w + 0.04, 0.01, 0.06, 0.05, 1.0),
    box(frame, w - 0.04, w, 0.01, 0.06, 0.05, 1.0),
    box(frame, -0.02, 0.02, 0.01, 0.06, 0.05, 1.0),
    box(frame, -w, w, 0, 0.05, h - 0.05, h),
  })
end

return parts
