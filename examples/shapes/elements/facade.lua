--!strict
-- Elements of facades. Each function takes a face, x to the right and y upwards, and returns a list of shapes.
local facade = {}

-- The part of a face from x0 to x1 and from y0 to y1 (m), measured from its lower left corner.
function facade.part(face: Shape, x0: number, x1: number, y0: number, y1: number): Shape?
  local corner, x, y = face:position(), face:x_axis(), face:y_axis()
  local part: Shape? = face
  for _, cut in { { x, x0, -1 }, { x, x1, 1 }, { y, y0, -1 }, { y, y1, 1 } } :: { any } do
    part = part and part:trim(corner + cut[1] * cut[2], cut[1] * cut[3])
  end
  return part
end

-- A pane behind a reveal of `depth` (m), with a frame of `width` (m) around it.
function facade.window(face: Shape, depth: number, width: number): { Shape }
  -- Without the tags of the wall, which can come from an extrusion too.
  local pane = face:untag("extrude"):shift(vec(0, 0, -depth))
  local reveal = pane:extrude(depth):joined_faces("tag:extrude.side") :: Shape
  local shapes = { reveal:reverse(), pane:color("#3f4f5c") }
  for _, strip in pane:border(width) do
    table.insert(shapes, strip:extrude(0.05):color("#e9e6df"))
  end
  return shapes
end

-- A balustrade on the lower part of a face: a rail at `height` (m) above a bottom rail, and bars about `distance` (m)
-- apart.
function facade.balustrade(face: Shape, height: number, distance: number): { Shape }
  local width = face:size().x
  local shapes: { Shape } = {}
  local function add(x0: number, x1: number, y0: number, y1: number, depth: number)
    local part = facade.part(face, x0, x1, y0, y1)
    if part then
      table.insert(shapes, part:extrude(depth):color("#3a3d40"))
    end
  end
  add(0, width, height - 0.06, height, 0.06)
  add(0, width, 0.08, 0.12, 0.04)
  local count = math.max(1, math.round(width / distance))
  for bar = 0, count do
    local x = 0.01 + (width - 0.02) * bar / count
    add(x - 0.01, x + 0.01, 0.12, height - 0.06, 0.02)
  end
  return shapes
end

return facade
