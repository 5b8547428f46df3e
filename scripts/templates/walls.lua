--!strict
-- The components of the styles: materials with images, openings, bays and whole storeys. Lengths are in metres.
local walls = {}

local IMAGES: { [string]: any } = {
  ashlar = { 2.4, 1.6 },
  azulejo = { 0.56, 0.56 },
  boards = { 1.6, 1.6 },
  brick = { 1, 0.6 },
  ribs = { 1, 1 },
  rubble = { 2, 2 },
  slates = { 2, 2 },
  tiles = { 1.8, 2.2 },
}

-- A rough material of this colour, with an optional image from the list above.
function walls.surface(color, image: string?, roughness: number?)
  local material: { [string]: any } = { color = color, roughness = roughness or 0.92, name = image }
  if image then
    material.texture = `templates/textures/{image}.png`
    material.texture_size = IMAGES[image]
  end
  return material
end

-- A hole of exactly `width` by `height` in the wall with a model that fills it, and a projecting surround. { width,
-- height, depth, model, surround, at, reveal, open }: an open one extends to the floor, like a door.
function walls.opening(o: any)
  local filled = panel({
    model = o.model,
    stretch = true,
    background = false,
    width = { o.width, o.width },
    height = { o.height, o.height },
    surface = if o.open then "door" else "window",
  })
  return extruded(filled, {
    depth = -(o.depth or 0.18),
    model = o.surround,
    at = o.at or "center",
    material = o.reveal,
    bottom = not o.open,
  })
end

-- A bay: an opening with at least `side` of wall on both sides, `sill` below it (less in low storeys), and at least
-- `top` above.
function walls.bay(opening, o)
  return bordered(opening, {
    left = o.side,
    right = o.side,
    bottom = { o.sill, if o.sill > 0.3 then "max" else "fixed" },
    top = o.top or 0.2,
    width = o.width,
    material = o.material,
  })
end

-- A band along a front, `height` high, that projects by `depth`.
function walls.band(height: number, depth: number, material: any): Wall
  local face = panel({ height = { height, height }, material = material })
  if depth == 0 then
    return face
  end
  return extruded(face, { depth = depth, material = material })
end

-- A cornice of steps, each with its height and its projection.
function walls.cornice(steps: any, material)
  local bands = {}
  for _, step in steps do
    table.insert(bands, walls.band(step[1], step[2], material))
  end
  return list(bands, { direction = "vertical" })
end

-- One storey of a building for frontages of every width.
--   bay      the repeated wall
--   narrow   the wall for frontages without room for a bay, or several, the narrowest first
--   street   the repeated wall on the street, instead of `bay`
--   entry    the bay with the entry door
--   ends     the first and the last bay on the street
--   jut      the projection of the whole storey
--   foot     a band below everything, and `head` a band above
--   material of all parts without their own, `party` that of party walls
function walls.storey(o: any): Facade
  local templates = {}
  local function add(keywords, wall, weight: number?)
    local stack = {}
    if o.foot then
      table.insert(stack, o.foot)
    end
    table.insert(stack, wall)
    if o.head then
      table.insert(stack, o.head)
    end
    local whole: Wall = if #stack > 1 then list(stack, { direction = "vertical" }) else wall
    if o.jut then
      whole = extruded(whole, { depth = o.jut :: number })
    end
    table.insert(templates, template(whole, { keywords = keywords, material = o.material, weight = weight }))
  end

  local street = o.street or o.bay
  local row, front = grid(o.bay, { rows = 1 }), grid(street, { rows = 1 })
  if o.entry then
    local words = { "street", "entry door" }
    add(words, list({ front, o.entry, front }), 2)
    add(words, list({ o.entry, front }), if o.aside then 2 else 0.4)
    add(words, list({ front, o.entry }), if o.aside then 2 else 0.4)
    local alone = o.entry:min_width() + street:min_width()
    add(words, bordered(o.entry, { width = { o.entry:min_width(), alone } }), 0)
  end
  if o.ends then
    add({ "street" }, list({ o.ends[1], front, o.ends[2] }))
  elseif o.street or o.entry then
    add({ "street" }, front)
  end
  -- Walls without a weight are used only if nothing else fits, the last one first.
  add({}, panel({}), 0)
  table.insert(templates, template(panel({}), { material = o.material, weight = 0 }))
  local narrow = if type(o.narrow) == "table" then o.narrow else { o.narrow }
  for _, wall in narrow do
    add({}, grid(wall, { rows = 1 }), 0)
  end
  add({}, row)
  table.insert(templates, template(panel({}), { keywords = { "blind" }, material = o.party or o.material }))
  return facade(templates)
end

return walls
