--!strict
-- Diffusion-limited aggregation: particles walk at random on a grid until they touch the cluster, and stay there. A
-- hook walks one particle for each tip in each step, and the rules let the cluster grow from the modules that were
-- touched.
-- Source: T. A. Witten and L. M. Sander, Diffusion-limited aggregation, 1981.
local particles = param("particles", { default = 600, min = 1, max = 3000, step = 1, doc = "Particles" })
local batch = param("batch", { default = 10, min = 1, max = 50, step = 1, doc = "Particles in a step" })
local inner = param("inner", { default = "#2f4f8f", doc = "Colour of the first particles" })
local outer = param("outer", { default = "#e0b040", doc = "Colour of the last particles" })

local Site = module("Site", "x", "y", "number")

local NEIGHBOURS = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } }

-- The number of each particle by its place. Places of new particles by the place that they touch: those that grow in
-- this step, and those that touch a particle of this step.
local cluster = variables({
  sites = { ["0,0"] = 0 } :: { [string]: number },
  growth = {} :: { [string]: { { number } } },
  waiting = {} :: { [string]: { { number } } },
  radius = 1,
  count = 0,
})

-- A number for each place, which is found faster than a string.
local function cell(x: number, y: number): number
  return x * 65536 + y
end

-- Returns the place of a particle that has walked to the cluster, and the place that it touches.
local function walk(taken: { [number]: boolean }, radius: number): (number, number, string)
  local x: number, y: number = 4 * radius + 99, 0
  while true do
    local free = vec(x, y, 0):length() - radius - 2
    if free > radius + 10 then
      -- Particles start on a circle around the cluster, and those that are far away start again.
      local angle = random(0, 2 * math.pi)
      x, y = math.round((radius + 3) * math.cos(angle)), math.round((radius + 3) * math.sin(angle))
    elseif free > 2 then
      -- In free space, a walk leaves a circle in any direction.
      local angle = random(0, 2 * math.pi)
      x, y = math.round(x + free * math.cos(angle)), math.round(y + free * math.sin(angle))
    else
      for _, step in NEIGHBOURS do
        if taken[cell(x + step[1], y + step[2])] then
          return x, y, `{x + step[1]},{y + step[2]}`
        end
      end
      local step = NEIGHBOURS[1 + math.floor(random(0, 4)) % 4]
      x, y = x + step[1], y + step[2]
    end
  end
end

local growth = lsystem({
  object = extruder({ sides = 4, smooth = false }),
  variables = cluster,
  interpret = "last",
})
growth:axiom(Site(0, 0, 0))
growth:before_step(function()
  local sites, new = table.clone(cluster.sites), table.clone(cluster.waiting)
  local radius, count = cluster.radius, cluster.count
  local taken: { [number]: boolean } = {}
  for place in sites do
    local x, y = string.match(place, "(.+),(.+)")
    taken[cell(tonumber(x) :: number, tonumber(y) :: number)] = true
  end
  for _ = 1, math.min(batch, particles - count) do
    local x, y, touched = walk(taken, radius)
    count += 1
    sites[`{x},{y}`], taken[cell(x, y)] = count, true
    local list = table.clone(new[touched] or {})
    table.insert(list, { x, y, count })
    new[touched] = list
    radius = math.max(radius, math.sqrt(x * x + y * y))
  end
  local growing: { [string]: { { number } } } = {}
  for _, site in query("select x, y from Site") do
    local place = `{site.x},{site.y}`
    growing[place], new[place] = new[place], nil
  end
  cluster.sites, cluster.radius, cluster.count = sites, radius, count
  cluster.growth, cluster.waiting = growing, new
end)
growth:rule("Site(x, y, number)", function(this, x: number, y: number, number: number): any
  local list: { any } = { Site(x, y, number) }
  for _, place in cluster.growth[`{x},{y}`] or {} do
    table.insert(list, { Site(place[1], place[2], place[3]) })
  end
  return sequence(list)
end)
growth:after_step(function(now)
  if now.counts.Site == particles + 1 then
    stop()
  end
end)
growth:interpret("Site(x, y, number)", function(this, x, y, number)
  this:jump({ x, y, 0 }):color(mix(inner, outer, number / particles)):scale(0.5):extrude(0.8)
end)
local result = growth:derive(particles)

expect(result.counts.Site, 1 + 600)
-- The number of particles within a radius grows by about its power 1.7, and not 2 as in a disc.
local function within(radius: number): number
  local number = 0
  for place in result.variables.sites do
    local x, y = string.match(place, "(.+),(.+)")
    local from_center = vec(tonumber(x) :: number, tonumber(y) :: number, 0):length()
    number += if from_center <= radius then 1 else 0
  end
  return number
end
local half = result.variables.radius / 2
expect(math.log(within(half) / within(half / 4), 4), 1.7, 0.2)
-- Picture: --azimuth 180 --elevation 75
