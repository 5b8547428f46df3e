--!strict
-- The SQL queries of these scripts: for the quarter of examples/data, or for another town with layers like those of
-- OpenStreetMap, in a GeoPackage, an extract, or on a PostGIS server.
-- burgeon run scripts/geospatial/town.lua --data ../shared/data --set town=helsinki.gpkg -o helsinki.glb
local town = param("town", {
  default = "quarter",
  doc = "The data: quarter, a file with layers of OpenStreetMap, or the address of a database",
})

type Layers = {
  buildings: string,
  neighbors: string,
  pavements: string,
  grass: string,
  flowerbeds: string,
  trees: string,
  parks: string,
  turned: string,
  furniture: string,
  roads: string,
}

if town == "quarter" then
  local names = { "buildings", "pavements", "grass", "flowerbeds", "trees", "parks", "furniture", "roads" }
  for _, name in names do
    source(`quarter/{name}.geojson`)
  end
  return {
    buildings = "select geom, id, floors, roof, style from buildings",
    neighbors = "select id from buildings where id <> $id and ST_Intersects(geom, $geom)",
    pavements = "select geom, code, level from pavements",
    grass = "select geom from grass",
    flowerbeds = "select geom, flowers from flowerbeds",
    trees = "select geom as place, species, height, radius from trees",
    parks = "select geom from parks",
    turned = "select geom as place, code, model, direction from furniture where direction is not null",
    furniture = "select geom as place, code from furniture where direction is null",
    roads = "select geom from roads order by geom <-> $place limit 2",
  } :: Layers
end

source(`{town}:buildings`, { where = "not part and building <> 'roof'" })
for _, name in { "roads", "trees", "furniture", "green" } do
  source(`{town}:{name}`)
end

-- A carriageway is the area within a distance of a road. Slabs cover the rest around the buildings, except water and
-- open land far from all buildings.
local PAVEMENTS = [[
  with carriageways as (
    select ST_Buffer(ST_Simplify(ST_Union(ST_Buffer(geom, case highway
      when 'primary' then 6 when 'secondary' then 5 when 'tertiary' then 4.5 when 'service' then 2.5 else 3.5 end,
      'quad_segs=2')), 0.1), -0.05, 'quad_segs=1') as geom
    from roads where highway in ('primary', 'secondary', 'tertiary', 'unclassified', 'residential', 'service')),
  town as (select ST_Buffer(ST_ConvexHull(ST_Collect(geom)), 10, 'quad_segs=1') as geom from buildings),
  ground as (
    select ST_Buffer(ST_Simplify(ST_Union(ST_Buffer(geom, 100, 'quad_segs=1')), 2), -80, 'quad_segs=1') as geom
    from buildings)
  select ST_Intersection(c.geom, t.geom) as geom, 1 as code, 0 as level from carriageways c, town t
  union all select ST_Buffer(ST_Difference(g.geom, c.geom), -0.05, 'quad_segs=1'), 2, 0.15 from carriageways c, ground g]]

return {
  -- If the number of storeys is unknown, a small building is a shed.
  buildings = [[
    select ST_GeometryN(geom, 1) as geom, id, fid % 4 + 1 as style, case when roof_shape = 'flat' then 1 else 2 end as roof,
      case when levels is not null then ceil(cast(levels as real)) when ST_Area(geom) < 90 then 1 else 5 end as floors
    from buildings]],
  neighbors = "select id from buildings where id <> $id and ST_Intersects(geom, $geom)",
  pavements = PAVEMENTS,
  grass = "select geom from green where kind in ('grass', 'garden')",
  -- A few shrubs form a bed.
  flowerbeds = [[
    select geom, fid % 4 + 1 as flowers from green
    where kind in ('flowerbed', 'shrubbery') or kind in ('scrub', 'heath') and ST_Area(geom) < 400]],
  trees = "select geom as place, fid % 5 + 1 as species, 7 + fid % 6 as height, 3 as radius from trees",
  parks = "select geom from green where kind = 'park' and ST_Area(geom) > 4000",
  -- Benches face away from the nearest road.
  turned = [[
    select f.geom as place, 3 as code, 'bench' as model, 270 - degrees(ST_Azimuth(f.geom, ST_ClosestPoint(
      (select r.geom from roads r order by r.geom <-> f.geom limit 1), f.geom))) as direction
    from furniture f where f.kind = 'bench']],
  furniture = [[
    select geom as place, case kind when 'bus_stop' then 1 when 'street_lamp' then 2 else 4 end as code
    from furniture where kind in ('bus_stop', 'street_lamp', 'column', 'billboard', 'poster_box')]],
  roads = "select geom from roads order by geom <-> $place limit 2",
} :: Layers
