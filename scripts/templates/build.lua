--!strict
-- Buildings of all styles: the styles by name, and the rules that turn a plan into groundwork, storeys and a roof.
local build = {}

build.names = {
  "haussmann",
  "glass_office",
  "modern_block",
  "porto",
  "church",
  "warehouse",
  "terrace_house",
  "half_timbered",
  "chalet",
  "villa",
}

-- The usual number of storeys of a style, the width (m) and depth of its buildings, and the distance between detached
-- buildings.
build.usual = {
  haussmann = { levels = 6, width = 15, depth = 12 },
  glass_office = { levels = 8, width = 18, depth = 14, gap = 6 },
  terrace_house = { levels = 3, width = 7, depth = 6.6 },
  porto = { levels = 4, width = 6, depth = 11 },
  half_timbered = { levels = 3, width = 7, depth = 9 },
  modern_block = { levels = 6, width = 15, depth = 12, gap = 6 },
  warehouse = { levels = 2, width = 18, depth = 14 },
  chalet = { levels = 2, width = 10, depth = 11, gap = 7 },
  villa = { levels = 2, width = 11, depth = 9, gap = 6 },
  church = { levels = 1, width = 12, depth = 14, gap = 4 },
}

-- All variants of all styles in one list, so that a number identifies a variant.
local styles: { any } = {}
local first: { [string]: any } = {}
local function add(name: string, variants: { any })
  first[name] = { at = #styles + 1, count = #variants }
  table.move(variants, 1, #variants, #styles + 1, styles)
end
for _, name in build.names do
  local variants = require(`templates/{name}`)
  add(name, variants.bowed or variants)
end
-- A terrace house with its front on the street.
add("row_house", require("templates/terrace_house").plain)

-- The number of a style's variant; `variant` is any integer from 1.
function build.style(name: string, variant: number): number
  local known = first[name]
  return known.at + (variant - 1) % known.count
end

-- The number of storeys of a building of this style with walls of `height` (m).
function build.levels(style: number, height: number): number
  local chosen = styles[style]
  return math.max(1, math.floor((height - chosen.ground) / chosen.storey + 1.5))
end

-- A style can choose the kind of each storey with `pick`; otherwise the first storey is its "ground" and all others
-- are "upper".
-- A building of `levels` storeys with walls of `height` (m), or of the style's height if that is 0.
build.Building = module("Building", "style", "levels", "height", "use")
local Groundwork = module("Groundwork", "style")
local Storey = module("Storey", "style", "kind", "height")
local Roof = module("Roof", "style", "kind")

-- Plans deeper than this (m) get the style's roof for wide plans.
local DEEP = 24
-- Plans smaller than this (m²) get the style's roof for towers.
local TOWER = 130

-- A system with a chain for every building; the modules of the chain are groundwork, storeys and a roof.
function build.system()
  local houses = lsystem({ object = footprint, interpret = "last" })

  houses:rule(
    "Building(style, levels, height, use)",
    function(this: Footprint, style: number, levels: number, height: number, use: string)
      local chosen: any = styles[style]
      local pick: ((...any) -> string)? = chosen.pick
      local usual = chosen.ground + (levels - 1) * chosen.storey
      local stretch = if height > 0 then height / usual else 1
      local chain = { Groundwork(style) }
      for number = 1, levels do
        local storey = if number == 1 then chosen.ground else chosen.storey
        local kind = if pick then pick(number, levels, use) elseif number == 1 then "ground" else "upper"
        table.insert(chain, Storey(style, kind, storey * stretch))
      end
      local deep, small = 4 * this:area() / this:perimeter() > DEEP, this:area() < TOWER
      local kind = if deep and chosen.wide then "wide" elseif small and chosen.tower then "tower" else "roof"
      table.insert(chain, Roof(style, kind))
      return table.unpack(chain)
    end
  )

  houses:interpret("Groundwork(style)", function(this, style)
    this:groundwork("extruded", styles[style].groundwork)
  end)
  houses:interpret("Storey(style, kind, height)", function(this, style, kind, height)
    this:walls({ height = height, templates = styles[style].walls[kind] })
  end)
  houses:interpret("Roof(style, kind)", function(this, style, kind)
    this:roof(styles[style][kind])
  end)
  return houses
end

return build
