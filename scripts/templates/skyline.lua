--!strict
-- Heights and plans of buildings: heights by the depth of the street, by noise, by the distance to centres or by a
-- mix; detached houses below a height, and skyscrapers among the highest buildings; plans inside their lot. A lot is
-- a result of network:lots or network:sites. Random numbers come from streams with the id of the lot as a key, so
-- buildings are independent.
local skyline = {}

export type Heights = {
  -- The criterion: "depth" of the street, "noise", "centres", "presets", or a mix: { depth = 0.7, noise = 0.3 }.
  by: (string | { [string]: number })?,
  -- The minimum and the maximum usual height (m).
  low: number?,
  high: number?,
  -- The factor of the heights at streets that are one level deeper.
  falloff: number?,
  -- The random fraction of the maximum height; it decreases with the height, to 0 for the minimum.
  spread: number?,
  -- Three heights (m) for a random choice.
  presets: { number }?,
  -- Positions (m), and the distance (m) at which heights are halved.
  centres: { { number } }?,
  reach: number?,
  -- The size (m) of the noise, and its seed.
  grain: number?,
  seed: number?,
  -- The factor of all heights.
  scale: number?,
  -- A building below this height (m) is a detached house.
  detached: number?,
  -- From this height (m), a building can be a skyscraper, with a maximum factor of its height.
  tall: number?,
  chance: number?,
  tower: number?,
}

export type Building = {
  kind: string,
  height: number,
  -- The height without a random part (m).
  base: number,
  -- Width along the street and depth (m).
  width: number,
  depth: number,
}

export type Plan = { { number } }
-- A part of a building between two heights (m).
export type Tier = { plan: Plan, holes: { Plan }?, from: number, to: number }

local USUAL = {
  by = { depth = 1 },
  low = 6,
  high = 36,
  falloff = 0.55,
  spread = 0.5,
  presets = { 6, 14, 30 },
  centres = { { 0, 0 } },
  reach = 300,
  grain = 220,
  seed = 1,
  scale = 1,
  detached = 10.5,
  tall = 30,
  chance = 0.12,
  tower = 2.6,
}

local RULES: { [string]: (lot: any, of: any, draw: (number?, number?) -> number) -> number } = {}

-- From 0, the minimum, to 1, the maximum.
function RULES.depth(lot, of)
  return of.falloff ^ (lot.street_depth or 0)
end

function RULES.noise(lot, of)
  local at = lot.access
  return 0.5 + 0.5 * noise(at.x / of.grain, at.y / of.grain, 0, of.seed)
end

function RULES.centres(lot, of)
  local nearest = math.huge
  for _, centre in of.centres do
    nearest = math.min(nearest, math.sqrt((lot.access.x - centre[1]) ^ 2 + (lot.access.y - centre[2]) ^ 2))
  end
  return 0.5 ^ (nearest / of.reach)
end

function RULES.presets(_, of, draw)
  local height = of.presets[math.min(#of.presets, 1 + math.floor(draw() * #of.presets))]
  return (height - of.low) / math.max(of.high - of.low, 1e-9)
end

-- The height of a building on a lot, its kind, and its preferred width and depth.
function skyline.building(lot: any, options: Heights?, drawn: ((number?, number?) -> number)?): Building
  local draw = drawn or stream("skyline", lot.id)
  local of: any = table.clone(USUAL :: any)
  for name, value in (options or {}) :: any do
    if (USUAL :: any)[name] == nil then
      error(`skyline: there is no option called {name}`)
    end
    of[name] = value
  end
  local mix: any = if type(of.by) == "string" then { [of.by] = 1 } else of.by
  local share, weights = 0, 0
  for _, name in { "depth", "noise", "centres", "presets" } do
    local weight = mix[name]
    if weight then
      share += weight * RULES[name](lot, of, draw)
      weights += weight
    end
  end
  if weights <= 0 then
    error('skyline: by has no rule: give "depth", "noise", "centres" or "presets", or a mix of them')
  end
  share /= weights
  local base = (of.low + (of.high - of.low) * share) * of.scale
  -- The random fraction of the height is proportional to the height.
  local height = base * (1 + (draw() - 0.5) * of.spread * math.clamp(share, 0, 1))
  local kind = if height < of.detached then "detached" else "block"
  local shorter, side, high, more = 0.5 + 0.5 * draw(), draw(), draw(), draw()
  if kind == "detached" then
    return { kind = kind, height = height, base = base, width = 11, depth = 9 }
  end
  if height >= of.tall and high < of.chance then
    kind, height = "tower", height * of.tower * (0.7 + 0.3 * more)
  end
  local width = 12 + height * 0.28
  local depth = 11 + height * 0.22
  if side < 0.5 then
    width *= shorter
  else
    depth *= shorter
  end
  return { kind = kind, height = height, base = base, width = width, depth = depth }
end

-- A lot in the frame of its front: x along the street, y away from it, the origin at the centre of the front.
local function frame(lot: any): (number, number, number, number)
  local facing = math.rad(lot.facing)
  return lot.access.x, lot.access.y, -math.sin(facing), math.cos(facing)
end

-- The rings of a lot in its frame: pieces { x1, y1, x2, y2 }.
local function border(lot: any): { { number } }
  local ox, oy, ax, ay = frame(lot)
  local pieces: { { number } } = {}
  for _, ring in lot.geometry.rings do
    local last = ring[#ring]
    for _, point in ring do
      local x1, y1 = last[1] - ox, last[2] - oy
      local x2, y2 = point[1] - ox, point[2] - oy
      local piece: { number } = {
        x1 * ax + y1 * ay,
        y1 * ax - x1 * ay,
        x2 * ax + y2 * ay,
        y2 * ax - x2 * ay,
      }
      table.insert(pieces, piece)
      last = point
    end
  end
  return pieces
end

-- Tests if a position is inside a boundary.
local function inside(pieces: { { number } }, x: number, y: number): boolean
  local odd = false
  for _, piece in pieces do
    if (piece[2] > y) ~= (piece[4] > y) then
      local t = (y - piece[2]) / (piece[4] - piece[2])
      if piece[1] + t * (piece[3] - piece[1]) > x then
        odd = not odd
      end
    end
  end
  return odd
end

-- The free distance to the left and to the right of `x` between y0 and y1; nil if it is not free there.
local function free(pieces: { { number } }, x: number, y0: number, y1: number): (number?, number)
  local left, right = -math.huge, math.huge
  for _, piece in pieces do
    local px, py, qx, qy = piece[1], piece[2], piece[3], piece[4]
    if math.max(py, qy) > y0 and math.min(py, qy) < y1 then
      local from, to = px, qx
      if py ~= qy then
        local slope = (qx - px) / (qy - py)
        from = px + (math.clamp(y0, math.min(py, qy), math.max(py, qy)) - py) * slope
        to = px + (math.clamp(y1, math.min(py, qy), math.max(py, qy)) - py) * slope
      end
      local low, high = math.min(from, to), math.max(from, to)
      if low <= x and high >= x then
        return nil, 0
      elseif high < x then
        left = math.max(left, high)
      else
        right = math.min(right, low)
      end
    end
  end
  return left, right
end

-- The largest box of up to `width` by `depth` (m) behind the front of a lot, at least `front` (m) from it and `side`
-- (m) from its boundary, in the lot's frame: { x0, y0, x1, y1 }. Nil if there is no room for a box of 4 m.
function skyline.box(lot: any, width: number, depth: number, front: number, side: number): { number }?
  local pieces = border(lot)
  local margin = math.max(side, 0.02)
  local back = math.max(front, margin + 0.01)
  local best: { number }?, most = nil, 0
  for _, size in { 1, 0.85, 0.7, 0.55, 0.42, 0.32 } do
    local d = depth * size
    if d < 4 or (best and d * width <= most) then
      break
    end
    for _, away in { 0, 0.2, 0.5 } do
      if d * width <= most then
        break
      end
      local y0 = back + away * d
      for _, x in { 0, 0.25 * width, -0.25 * width } do
        local left, right = free(pieces, x, y0 - margin, y0 + d + margin)
        if left and inside(pieces, x, y0 + d / 2) then
          local w = math.min(width, right - left - 2 * margin - 1e-6)
          if w >= 4 and w * d > most then
            -- As near to the centre of the front as there is room.
            local x0 = math.clamp(-w / 2, left + margin, right - margin - w)
            best, most = { x0, y0, x0 + w, y0 + d }, w * d
          end
          break
        end
      end
    end
  end
  return best
end

-- Points of a lot's frame as positions (m).
local function placed(lot: any, points: Plan): Plan
  local ox, oy, ax, ay = frame(lot)
  local ring: Plan = {}
  for _, point in points do
    local place: { number } = { ox + point[1] * ax - point[2] * ay, oy + point[1] * ay + point[2] * ax }
    table.insert(ring, place)
  end
  return ring
end

local function rectangle(x0: number, y0: number, x1: number, y1: number): Plan
  return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } }
end

-- The forms of plans: each accepts a box { x0, y0, x1, y1 }, the width of wings (m) and a number from 0 to 1, and
-- returns an outline and holes.
local FORMS: { [string]: (box: { number }, wing: number, draw: number) -> (Plan, { Plan }?) } = {}

function FORMS.box(b: { number }, _: number, _: number): (Plan, { Plan }?)
  return rectangle(b[1], b[2], b[3], b[4]), nil
end

function FORMS.L(b: { number }, wing: number, draw: number): (Plan, { Plan }?)
  local x0, y0, x1, y1 = b[1], b[2], b[3], b[4]
  if draw < 0.5 then
    return {
      { x0, y0 },
      { x1, y0 },
      { x1, y0 + wing },
      { x0 + wing, y0 + wing },
      { x0 + wing, y1 },
      { x0, y1 },
    },
      nil
  end
  return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x1 - wing, y1 }, { x1 - wing, y0 + wing }, { x0, y0 + wing } },
    nil
end

function FORMS.T(b: { number }, wing: number, draw: number): (Plan, { Plan }?)
  local x0, y0, x1, y1 = b[1], b[2], b[3], b[4]
  local middle = x0 + wing / 2 + (x1 - x0 - wing) * (0.3 + 0.4 * draw)
  local l, r = middle - wing / 2, middle + wing / 2
  local behind = y0 + wing
  return {
    { x0, y0 },
    { x1, y0 },
    { x1, behind },
    { r, behind },
    { r, y1 },
    { l, y1 },
    { l, behind },
    { x0, behind },
  },
    nil
end

function FORMS.U(b: { number }, wing: number, _: number): (Plan, { Plan }?)
  local x0, y0, x1, y1 = b[1], b[2], b[3], b[4]
  local l, r, behind = x0 + wing, x1 - wing, y0 + wing
  return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { r, y1 }, { r, behind }, { l, behind }, { l, y1 }, { x0, y1 } },
    nil
end

function FORMS.court(b: { number }, wing: number, _: number): (Plan, { Plan }?)
  local x0, y0, x1, y1 = b[1], b[2], b[3], b[4]
  local yard = rectangle(x0 + wing, y0 + wing, x1 - wing, y1 - wing)
  return rectangle(x0, y0, x1, y1), { { yard[4], yard[3], yard[2], yard[1] } }
end

skyline.forms = { "box", "L", "T", "U", "court", "stepped", "row" }

export type Plans = {
  -- A name of skyline.forms; by default chosen at random by the size of the box. A "row" touches its neighbours.
  form: string?,
  -- The minimum distance (m) to the front and to the rest of the boundary.
  front: number?,
  side: number?,
  -- The width of wings (m).
  wing: number?,
}

-- A form that suits a box of this size.
local function suits(width: number, depth: number, wing: number, draw: number): string
  local fitting = { "box" }
  if width > 1.8 * wing and depth > 1.6 * wing then
    table.insert(fitting, "L")
    table.insert(fitting, "T")
  end
  if width > 2.6 * wing and depth > 1.6 * wing then
    table.insert(fitting, "U")
  end
  if width > 2.7 * wing and depth > 2.7 * wing then
    table.insert(fitting, "court")
  end
  return fitting[math.min(#fitting, 1 + math.floor(draw * #fitting))]
end

-- The whole lot as a plan up to `depth` (m) behind its front, for rows of adjoining buildings with a distance of
-- `gap` (m).
function skyline.row(lot: any, depth: number, gap: number?): any
  local wide = lot.width + lot.depth + 10
  local band = polygon(placed(lot, rectangle(-wide, -wide, wide, depth)))
  return lot.geometry:inset((gap or 0.04) / 2):intersection(band)
end

-- The parts of a building on a lot, from bottom to top; none if the lot has no room for it. They are inside the lot.
function skyline.plan(
  lot: any,
  building: Building,
  options: Plans?,
  drawn: ((number?, number?) -> number)?
): { Tier }
  local next = drawn or stream("skyline plan", lot.id)
  local of: Plans = options or {}
  local front, side = of.front or 2, of.side or 1.5
  local draw, other = next(), next()
  if of.form == "row" then
    local best, most = nil, 0
    for _, part in skyline.row(lot, math.max(building.depth, 6)):geometries() do
      if part:area() > most then
        best, most = part, part:area()
      end
    end
    if not best or most < 16 then
      return {}
    end
    local holes: { Plan } = table.move(best.rings, 2, #best.rings, 1, {})
    return { { plan = best.rings[1], holes = holes, from = 0, to = building.height } }
  end
  local box = skyline.box(lot, building.width, building.depth, front, side)
  if not box then
    return {}
  end
  local width, depth = box[3] - box[1], box[4] - box[2]
  local wing = math.min(of.wing or 7, width, depth)
  local form: string = of.form or ""
  if form == "" then
    form = if building.kind == "tower" then "stepped" else suits(width, depth, wing, draw)
  end
  local height = building.height
  if form == "stepped" then
    local tiers: { Tier } = {}
    local from, inset = 0, 0
    for number, part in { 0.4, 0.75, 1 } do
      local to = height * part
      local w, d = width - 2 * inset, depth - 2 * inset
      -- A small box is not a stepped tower.
      if #tiers > 0 and (w < 5 or d < 5) then
        tiers[#tiers].to = height
        break
      end
      local plan = rectangle(box[1] + inset, box[2] + inset, box[3] - inset, box[4] - inset)
      local tier: Tier = { plan = placed(lot, plan), from = from, to = to }
      table.insert(tiers, tier)
      from = to
      inset += math.min(width, depth) * (0.06 + 0.06 * (if number == 1 then draw else other))
    end
    return tiers
  end
  local make = FORMS[form]
  if not make then
    error(`skyline: there is no form called {form}: it is one of {table.concat(skyline.forms, ", ")}`)
  end
  -- Wings leave at least a third of the box open.
  local thin = math.min(wing, 0.36 * width, 0.6 * depth)
  if form == "court" then
    thin = math.min(thin, 0.36 * depth)
  end
  local outline, holes = make(box, thin, other)
  local tier: Tier = { plan = placed(lot, outline), from = 0, to = height }
  if holes then
    local there: { Plan } = {}
    for _, hole in holes do
      table.insert(there, placed(lot, hole))
    end
    tier.holes = there
  end
  return { tier }
end

-- The parts of a building as features, as a source for a system of footprints. Each has an id, its geometry (at the
-- height of its base), its height, the kind and the height of its building, its lot, and tier, from 1.
function skyline.features(lot: any, building: Building, tiers: { Tier }): { any }
  local features = {}
  for number, tier in tiers do
    local rings = {}
    for _, ring in { tier.plan, table.unpack(tier.holes or {}) } do
      local high = {}
      for _, point in ring do
        table.insert(high, { point[1], point[2], tier.from })
      end
      table.insert(rings, high)
    end
    table.insert(features, {
      id = `{lot.id}.{number}`,
      geometry = { rings = rings },
      height = tier.to - tier.from,
      tier = number,
      kind = building.kind,
      total = building.height,
      lot = lot,
    })
  end
  return features
end

-- The buildings of lots as skyline.features, with the parts of each from bottom to top, and the lots without room for
-- a building.
function skyline.buildings(lots: { any }, heights: Heights?, plans: Plans?, seed: number?): ({ any }, { any })
  local features, empty = {}, {}
  for _, lot in lots do
    local draw = stream("skyline", lot.id, seed or 0)
    local building = skyline.building(lot, heights, draw)
    local parts = skyline.features(lot, building, skyline.plan(lot, building, plans, draw))
    table.move(parts, 1, #parts, #features + 1, features)
    if #parts == 0 then
      table.insert(empty, lot)
    end
  end
  return features, empty
end

return skyline
