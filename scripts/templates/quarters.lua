--!strict
-- The quarters of a city: their positions, street patterns, block divisions and buildings.
local roads = require("templates/roads")
local skyline = require("templates/skyline")
local quarters = {}

-- Photos of some bays and four storeys: the size (m) of a bay, the number of bays, and the brightness of the wall
-- from 0 to 1.
local FACADES: { [string]: any } = {
  stone = { texture = "windows_stone", bay = { 2.6, 3.3 }, count = 4, light = 0.72 },
  brick = { texture = "windows_brick", bay = { 2.7, 3.0 }, count = 4, light = 0.55 },
  flats = { texture = "windows_flats", bay = { 3.0, 2.9 }, count = 4, light = 0.8 },
  office = { texture = "windows_office", bay = { 1.5, 3.6 }, count = 8, light = 0.35 },
  tower = { texture = "windows_tower", bay = { 1.8, 3.3 }, count = 6, light = 0.78 },
}

type Look = { facade: string, tints: { string }, roof: any }
local LOOKS: { [string]: Look } = {
  old = {
    facade = "stone",
    tints = { "#f4e6cc", "#f2d9b8", "#e9d2c0", "#f7efe0", "#dfe0cf", "#efcfae" },
    roof = { kind = "gable", slope = 38, color = "#9a5a43" },
  },
  blocks = {
    facade = "stone",
    tints = { "#fbf6ea", "#f3e9d8", "#efe6da", "#f7f1e6" },
    roof = { kind = "mansard", height = 3.6, color = "#66707a" },
  },
  rows = {
    facade = "brick",
    tints = { "#c98a6f", "#b97a62", "#d3a183", "#c9ad98", "#b3705a" },
    roof = { kind = "gable", slope = 35, color = "#6a5f5a" },
  },
  flats = {
    facade = "flats",
    tints = { "#ffffff", "#f4ead9", "#e6ecec", "#f3e3d2" },
    roof = { kind = "flat", border = 0.6, border_width = 0.3, color = "#a09d96" },
  },
  office = {
    facade = "office",
    tints = { "#ffffff", "#dfe9ef", "#cfd9dd", "#e9e2d6" },
    roof = { kind = "flat", border = 0.8, border_width = 0.3, color = "#8c8f90" },
  },
  tower = {
    facade = "tower",
    tints = { "#f6f1e8", "#d9d6cf", "#c7cdd2", "#e3d3bf", "#d3c8bb" },
    roof = { kind = "flat", border = 0.8, border_width = 0.3, color = "#97958f" },
  },
  villa = {
    facade = "brick",
    tints = { "#f6efe2", "#efe0c8", "#e2cdb6", "#fffaf0", "#cfa58c" },
    roof = { kind = "hip", slope = 32, overhang = 0.5, color = "#8d4f3b" },
  },
}

-- An element of a list, chosen at random by the lot's own numbers.
local function one<T>(list: { T }, draw: number): T
  return list[math.min(#list, 1 + math.floor(draw * #list))]
end

-- The influence of the street's depth on the height of rows, and the factor per depth.
local BY_DEPTH, FALLOFF = 0.75, 0.5

-- Rows of adjoining buildings, from `low` to `high` (m) in whole storeys of 3.1 m, higher at larger streets; also
-- returns the lots without a building.
local function row(lots: { any }, low: number, high: number, look: string, style: string): ({ any }, { any })
  local features, empty = {}, {}
  for _, lot in lots do
    local draw = stream("row", lot.id)
    local share = BY_DEPTH * FALLOFF ^ (lot.street_depth or 0) + (1 - BY_DEPTH) * draw()
    local height = 3.1 * math.floor((low + (high - low) * share) / 3.1 + 0.5)
    local before = #features
    for number, part in lot.terrace do
      if part:area() > 30 then
        table.insert(features, {
          id = `{lot.id}.{number}`,
          geometry = part,
          height = height,
          tier = 1,
          total = height,
          kind = look,
          look = look,
          style = style,
          lot = lot,
        })
      end
    end
    if #features == before then
      table.insert(empty, lot)
    end
  end
  return features, empty
end

-- Detached slabs and towers of flats, as long as their lot allows.
local function flats(lots: { any }): ({ any }, { any })
  local features, empty = {}, {}
  for _, lot in lots do
    local draw = stream("flats", lot.id)
    local building = skyline.building(lot, {
      by = { noise = 0.4, depth = 0.6 },
      low = 11,
      high = 30,
      detached = 0,
      tall = 24,
      chance = 0.12,
      tower = 1.8,
    }, draw)
    if building.kind ~= "tower" then
      building.width, building.depth = 60, 14 + 24 * draw()
    end
    building.height = 2.9 * math.floor(building.height / 2.9 + 0.5)
    local tiers = skyline.plan(lot, building, { front = 5, side = 5, wing = 12 }, draw)
    if #tiers == 0 then
      table.insert(empty, lot)
    end
    for _, feature in skyline.features(lot, building, tiers) do
      feature.look, feature.style = "flats", "modern_block"
      table.insert(features, feature)
    end
  end
  return features, empty
end

-- Detached buildings by the rules of the skyline; `looks` sets the appearance of each kind.
local function standing(
  lots: { any },
  heights,
  plans,
  looks: { [string]: string },
  styles: { [string]: string }
): ({ any }, { any })
  local features, empty = skyline.buildings(lots, heights, plans)
  for _, feature in features do
    feature.look = looks[feature.kind]
    feature.style = styles[feature.kind]
  end
  return features, empty
end

export type Quarter = {
  ground: string,
  lots: { [string]: any },
  -- Returns the buildings of lots, and the lots without room for a building.
  buildings: (lots: { any }, highest: number, extent: number) -> ({ any }, { any }),
}

quarters.kinds = {
  centre = {
    ground = "#aaa79f",
    lots = { kind = "boxes", width = 34, depth = 36, jitter = 0.4, parks = 0.04 },
    buildings = function(lots: { any }, highest: number, extent: number)
      return standing(lots, {
        by = { centres = 0.6, depth = 0.4 },
        low = 17,
        high = highest,
        reach = extent * 0.16,
        detached = 0,
        tall = highest * 0.62,
        chance = 0.35,
        tower = 2.1,
      }, { front = 1, side = 1.2 }, { block = "office", tower = "tower", detached = "flats" }, {
        block = "glass_office",
      })
    end,
  },
  old = {
    ground = "#a39d90",
    lots = {
      kind = "strips",
      width = 9,
      depth = 15,
      min_width = 5.5,
      jitter = 0.5,
      parks = 0.03,
      elongation = 7,
      terrace = 12,
    },
    buildings = function(lots: { any })
      return row(lots, 8, 19, "old", "porto")
    end,
  },
  blocks = {
    ground = "#8f9678",
    lots = {
      kind = "strips",
      width = 18,
      depth = 17,
      min_width = 9,
      jitter = 0.3,
      parks = 0.06,
      elongation = 6,
      terrace = 13.5,
    },
    buildings = function(lots: { any })
      return row(lots, 13, 27, "blocks", "haussmann")
    end,
  },
  flats = {
    ground = "#7f9060",
    lots = { kind = "boxes", width = 46, depth = 40, jitter = 0.3, parks = 0.08 },
    buildings = flats,
  },
  rows = {
    ground = "#7d8d59",
    lots = {
      kind = "strips",
      width = 6.6,
      depth = 24,
      min_width = 5,
      jitter = 0.1,
      parks = 0.05,
      elongation = 9,
      terrace = 10,
    },
    buildings = function(lots: { any })
      return row(lots, 5, 13, "rows", "row_house")
    end,
  },
  villas = {
    ground = "#76894f",
    lots = { kind = "boxes", width = 20, depth = 26, jitter = 0.35, parks = 0.04 },
    buildings = function(lots: { any })
      return standing(
        lots,
        {
          low = 5,
          high = 7.6,
          detached = 30,
          tall = 100,
        },
        { front = 5, side = 2.5 },
        { detached = "villa", block = "villa", tower = "villa" },
        { detached = "villa" }
      )
    end,
  },
} :: { [string]: Quarter }

-- The positions of quarters: { at, kind, pattern }. The centre is "towers", "old town" or "boulevards".
function quarters.places(extent: number, heart: string): { any }
  local turned = random(0, 360)
  local middle = { 0, extent * 0.05 }
  local hearts: { [string]: any } = {
    towers = {
      kind = "centre",
      pattern = roads.raster({ block = 105, width = 80, angle = turned, gap = 0.2, variety = 0.5 }),
    },
    ["old town"] = {
      kind = "old",
      pattern = roads.organic({ block = 62, bends = 28, gap = 0.2, variety = 0.4 }),
    },
    boulevards = {
      kind = "blocks",
      pattern = roads.radial({ middle = middle, block = 95, gap = 0.1, variety = 0.2 }),
    },
  }
  local places = { { at = middle, kind = hearts[heart].kind, pattern = hearts[heart].pattern } }
  local function around(share: number, angle: number, kind: string, pattern)
    local way = math.rad(turned + angle)
    local at = { math.cos(way) * extent * share, math.sin(way) * extent * share }
    table.insert(places, { at = at, kind = kind, pattern = pattern })
  end
  -- Next to an old centre are new towers.
  local first = if heart == "old town" then "blocks" else "old"
  around(0.42, 20, first, roads.organic({ block = 58, bends = 30, gap = 0.2, variety = 0.4 }))
  around(0.42, 110, "blocks", roads.radial({ middle = middle, block = 85, gap = 0.1, variety = 0.2 }))
  around(0.4, 200, "blocks", roads.organic({ block = 88, bends = 32, gap = 0.2, variety = 0.4 }))
  around(
    0.44,
    290,
    "flats",
    roads.raster({ block = 120, width = 100, angle = (turned + 30) % 360, gap = 0.2, variety = 0.5 })
  )
  around(
    0.8,
    50,
    "rows",
    roads.raster({ block = 120, width = 62, angle = (turned + 55) % 360, gap = 0.2, variety = 0.5 })
  )
  around(0.8, 125, "villas", roads.organic({ block = 85, bends = 34, gap = 0.2, variety = 0.4 }))
  around(
    0.8,
    195,
    "rows",
    roads.raster({ block = 110, width = 64, angle = (turned - 20) % 360, gap = 0.2, variety = 0.5 })
  )
  around(0.8, 265, "flats", roads.organic({ block = 110, bends = 32, gap = 0.2, variety = 0.4 }))
  around(0.8, 335, "villas", roads.organic({ block = 90, bends = 30, gap = 0.2, variety = 0.4 }))
  return places
end

-- The street pattern at each position.
function quarters.pattern(places: { any })
  return roads.districts(places)
end

-- The kind of the quarter at a position.
function quarters.at(places: { any }, at: any): string
  local best: any, least = places[1], math.huge
  for _, place in places do
    local away = (at:x() - place.at[1]) ^ 2 + (at:y() - place.at[2]) ^ 2
    if away < least then
      best, least = place, away
    end
  end
  return best.kind
end

-- Buildings on a terrain: their plans are on the terrain, and upper parts keep their height above lower parts.
function quarters.raised(buildings: { any }, height: (x: number, y: number) -> number): { any }
  local high: { [string]: number } = {}
  local raised = {}
  for _, building in buildings do
    local whole: string = building.lot.id
    local from: number? = if building.tier > 1 then high[whole] else nil
    local top = -math.huge
    local rings = {}
    for _, ring in building.geometry.rings do
      local laid = {}
      for _, point in ring do
        local on = height(point[1], point[2])
        top = math.max(top, on)
        table.insert(laid, { point[1], point[2], if from then from + point[3] else on })
      end
      table.insert(rings, laid)
    end
    if building.tier == 1 then
      high[whole] = top
    end
    local copy = table.clone(building)
    copy.geometry = { rings = rings }
    table.insert(raised, copy)
  end
  return raised
end

local Area = module("Area", "rings", "from", "to", "color")

-- Draws polygons between two heights (m).
function quarters.areas(geometries: { any }, from: number, to: number, color: string)
  local features = {}
  for _, geometry in geometries do
    for _, part in geometry:geometries() do
      table.insert(features, { id = `{color} {#features}`, geometry = part })
    end
  end
  if #features == 0 then
    return
  end
  local system = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
  system:axiom(source(features), function(feature)
    return Area(feature.geometry, from, to, color)
  end)
  system:interpret("Area(shape, from, to, color)", function(this, shape, from, to, color)
    this:color(color):polygon(shape):jump({ 0, 0, from }):extrude(to - from)
  end)
  system:derive(0)
end

-- The streets of a network, for doors and shops on the street side of buildings.
function quarters.ways(network: Network): any
  return streets(network:streets())
end

-- The report about a building.
function quarters.attributes(feature: any): { [string]: any }
  return {
    kind = feature.kind,
    tier = feature.tier,
    total = feature.total,
    street_depth = feature.lot.street_depth or 0,
  }
end

local Block = module("Block", "plan", "look", "tint", "height", "is_top")

-- Buildings without their own facades: photos of windows in whole bays, and a roof.
function quarters.distant(buildings: { any })
  if #buildings == 0 then
    return
  end
  local tops: { [string]: number } = {}
  for _, building in buildings do
    local whole = building.lot.id
    tops[whole] = math.max(tops[whole] or 0, building.tier)
  end
  local system = lsystem({ object = footprint, interpret = "last" })
  system:axiom(source(buildings), function(feature: any)
    local look: string = feature.look
    local draw = stream("tint", feature.lot.id)
    local tint: any = one(LOOKS[look].tints, draw())
    return footprint(feature.geometry, { attributes = quarters.attributes(feature) }),
      Block(feature.geometry, look, tint, feature.height, feature.tier == tops[feature.lot.id])
  end)
  system:interpret(
    "Block(plan, look, tint, height, is_top)",
    function(this: Footprint, plan, look: string, tint: string, height: number, is_top: boolean)
      local chosen = LOOKS[look]
      local facade = FACADES[chosen.facade]
      local bay = facade.bay
      local photo = {
        texture = `templates/textures/{facade.texture}.png`,
        texture_size = { bay[1] * facade.count, bay[2] * 4 },
        color = tint,
        roughness = 0.85,
      }
      -- Walls without windows have the brightness of the photo's walls.
      local plain = mix("#000000", tint, facade.light)
      if this:highest() > this:lowest() + 0.01 then
        this:groundwork("extruded")
      end
      this:walls({ height = height, photo = photo, bay = bay, color = plain })
      this:roof(if is_top then chosen.roof else { kind = "flat", color = "#96938d" })
    end
  )
  system:derive(0)
end

return quarters
