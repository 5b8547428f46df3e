--!strict
-- A Parisian apartment house: shops in a rusticated ground floor, balconies along the second and the last storey, a
-- cornice, and a zinc mansard roof with dormers and broad chimneys.
local parts = require("templates/parts")
local walls = require("templates/walls")

local STONES = { "#dccfb4", "#d5c8ae", "#e0d6c1" }
local SHOPS = { "#24362f", "#4a2320", "#22303f" }
local AWNINGS = { "#8a5048", "#55695c", "#566578" }

local window = parts.window({ width = 1.2, height = 2.15, color = "#dcd8cc", rows = 3 })
local tall = parts.window({ width = 1.2, height = 2.45, color = "#dcd8cc", rows = 4 })
local slim = parts.window({ width = 0.7, height = 2.0, color = "#dcd8cc", columns = 1, rows = 3 })
local door = parts.door({ width = 1.9, height = 3.1, color = "#2c3f35", wings = 2, transom = 0.7 })
local dormer = parts.dormer({ width = 1.5, height = 1.75, depth = 2.6, color = "#d3c7ad", roof = parts.zinc })
local chimney =
  parts.chimney({ width = 2.6, depth = 0.6, height = 1.5, color = "#c6b08f", pots = 6, across = true })

local function make(stone: string, shop_color: string, awning: string)
  local ashlar = walls.surface(stone, "ashlar")
  local smooth = walls.surface(mix(stone, "#ffffff", 0.12))
  local base = walls.surface(mix(stone, "#8c8474", 0.25), "ashlar")

  local display = parts.shop({ width = 2.7, height = 3.1, color = shop_color })
  local shaded = parts.shop({ width = 2.7, height = 3.1, color = shop_color, awning = awning })
  local trim = parts.surround({
    width = 1.2,
    height = 2.15,
    jamb = 0.16,
    head = 0.2,
    material = smooth,
    keystone = true,
  })
  local plain_trim = parts.surround({ width = 0.7, height = 2.0, jamb = 0.1, material = smooth })
  local portal = parts.portal({
    width = 1.9,
    height = 3.1,
    jamb = 0.3,
    head = 0.3,
    out = 0.14,
    material = smooth,
    keystone = true,
  })
  local bay_of_balcony = parts.gallery({ width = 2.4, height = 3.2, depth = 0.65, material = smooth })
  local left = parts.gallery({ width = 0.5, height = 3.2, ending = -1, material = smooth })
  local right = parts.gallery({ width = 0.5, height = 3.2, ending = 1, material = smooth })
  local balcony = parts.balcony({
    width = 1.2,
    height = 2.45,
    depth = 0.32,
    side = 0.22,
    jamb = 0.14,
    slab = 0.18,
    material = smooth,
  })

  local width = { 2.1, 2.5, 4.2 }
  local pane = walls.opening({
    width = 1.2,
    height = 2.15,
    depth = 0.28,
    model = window,
    surround = trim,
    reveal = smooth,
  })
  local plain = walls.bay(pane, { side = 0.42, sill = 0.6, width = width })
  local french = walls.opening({ width = 1.2, height = 2.45, depth = 0.28, model = tall, reveal = smooth })
  local above = walls.bay(french, { side = 0.42, sill = 0.18, width = width })
  local framed = walls.opening({
    width = 1.2,
    height = 2.45,
    depth = 0.28,
    model = tall,
    surround = balcony,
    reveal = smooth,
  })
  local with_balcony = walls.bay(framed, { side = 0.42, sill = 0.2, top = 0.3, width = width })
  local running = extruded(above, { model = bay_of_balcony, stretch = true })
  local lower = walls.bay(pane, { side = 0.42, sill = 0.18, width = width })
  local running_low = extruded(lower, { model = bay_of_balcony, stretch = true })
  local first = panel({ model = left, stretch = true, width = { 0.5, 0.5 } })
  local last = panel({ model = right, stretch = true, width = { 0.5, 0.5 } })
  local narrow = walls.bay(
    walls.opening({
      width = 0.7,
      height = 2.0,
      depth = 0.25,
      model = slim,
      surround = plain_trim,
      reveal = smooth,
    }),
    { side = 0.2, sill = 0.7 }
  )

  local function display_bay(model)
    return walls.bay(walls.opening({ width = 2.7, height = 3.1, depth = 0.22, model = model, open = true }), {
      side = 0.35,
      sill = 0,
      width = { 3.4, 3.7, 6.6 },
    })
  end
  local entry = walls.bay(
    walls.opening({
      width = 1.9,
      height = 3.1,
      depth = 0.45,
      model = door,
      surround = portal,
      at = "bottom",
      open = true,
    }),
    { side = 0.5, sill = 0, top = 0.32, width = { 2.9, 3.1, 4 } }
  )
  local course = walls.cornice({ { 0.12, 0.1 }, { 0.1, 0.18 } }, smooth)
  local cornice = walls.cornice({ { 0.2, 0.08 }, { 0.16, 0.3 }, { 0.14, 0.48 } }, smooth)
  local party = walls.surface("#b9ad98")

  local function ground(street)
    return walls.storey({
      bay = walls.bay(pane, { side = 0.42, sill = 1.0, width = width }),
      narrow = narrow,
      street = street,
      entry = entry,
      head = course,
      material = base,
      party = party,
    })
  end
  local upper = walls.storey({ bay = plain, narrow = narrow, material = ashlar, party = party })
  local second = walls.storey({
    bay = with_balcony,
    narrow = narrow,
    street = running,
    ends = { first, last },
    material = ashlar,
    party = party,
  })
  local top = walls.storey({
    bay = plain,
    narrow = narrow,
    street = running_low,
    ends = { first, last },
    head = cornice,
    material = ashlar,
    party = party,
  })
  local low_top =
    walls.storey({ bay = plain, narrow = narrow, head = cornice, material = ashlar, party = party })
  return {
    name = "haussmann",
    storey = 3.2,
    ground = 4.1,
    walls = {
      ground = ground(display_bay(display)),
      shop = ground(display_bay(shaded)),
      upper = upper,
      second = second,
      top = top,
      low_top = low_top,
    },
    pick = function(number: number, levels: number, use: string?): string
      if number == 1 then
        return if use == "shop" then "shop" else "ground"
      elseif number == levels then
        return if levels > 4 then "top" else "low_top"
      end
      return if number == 3 then "second" else "upper"
    end,
    groundwork = walls.surface("#a79c88", "ashlar"),
    roof = {
      kind = "mansard",
      height = 4.6,
      overhang = 0.25,
      slab = 0.2,
      material = walls.surface("#7b838b", nil, 0.55),
      trim = smooth,
      details = {
        { model = dormer, on = "slope", flap = 1, every = 2.5, margin = 2.2, offset = 0.35 },
        { model = chimney, on = "ridge", every = 9, margin = 1.5, sink = 0.2 },
        { model = chimney, on = "hip", margin = 2, count = 2, chance = 0.5 },
      },
    },
    wide = { kind = "mansard", height = 4, overhang = 0.25, slab = 0.2, material = parts.zinc, trim = smooth },
  }
end

local variants = {}
for index, stone in STONES do
  table.insert(variants, make(stone, SHOPS[index], AWNINGS[index]))
end
return variants
