//! Meshes of terrain tiles.

use std::path::Path;
use std::sync::Arc;

use burgeon_base::Budget;
use burgeon_base::error::Result;
use burgeon_data::elevation::{HeightOptions, Raster, Relief};
use burgeon_export::gltf::TileModelOptions;
use burgeon_scene::{Instance, Material, Mesh, Normal, Scene};
use burgeon_spatial::{Crs, ReferenceFrame};
use glam::{DAffine3, DVec2, DVec3, Vec2, Vec3, Vec4};

use super::ground_image::{GroundColors, GroundImage};
use super::tile::{BuiltTile, TileContent};
use crate::plan::{PlannedTerrain, PlannedTile, TileGrid};

/// Heights of a terrain in the coordinates of a run.
pub struct TerrainHeights(Relief);

/// Radius (m) of the earth, for the error of flat triangles.
const RADIUS: f64 = 6.37e6;

/// Number of points along a side of a tile.
const POINTS: usize = PlannedTerrain::SQUARES as usize + 1;

impl TerrainHeights {
    /// Reads a grid of heights, in a format such as GeoTIFF; `name` is its name in messages. A file without a coordinate system is in
    /// that of the frame.
    ///
    /// Fails if the file cannot be read, or if it is too far from the frame.
    pub fn open(path: &Path, name: &str, frame: &ReferenceFrame) -> Result<Self> {
        let mut raster = Raster::open(path, name, &HeightOptions::default(), &Budget::default())?;
        if let (None, Some(code)) = (&raster.crs, frame.epsg) {
            raster.crs = Some(Crs::epsg(code.into())?);
        }
        Ok(Self(Relief::new(Arc::new(raster), &mut Some(frame.clone()))?))
    }

    /// Returns west, south, east and north (m) of the heights.
    pub fn area(&self) -> [f64; 4] {
        let (low, high) = (self.0.low(), self.0.high());
        [low.x, low.y, high.x, high.y]
    }

    /// Returns the distance (m) between adjacent heights.
    pub fn step(&self) -> f64 {
        self.0.step()
    }

    fn height(&self, x: f64, y: f64) -> Option<f64> {
        self.0.height(DVec2::new(x, y))
    }

    /// Builds a tile: a grid of triangles over its square, as far as there are heights, with skirts at its sides, and an image of
    /// `colors`. The error of the content is the largest distance (m) from the next finer grid.
    ///
    /// The skirts of two tiles of any levels cover the gap between them: a skirt is as deep as the side is above the same side in any
    /// other level. The content is an error as soon as `proceed` fails, which is called before each row of the image.
    pub fn build(
        &self,
        terrain: &PlannedTerrain,
        tile: &PlannedTile,
        model: TileModelOptions,
        colors: &dyn GroundColors,
        proceed: &(impl Fn() -> Result<()> + Sync),
    ) -> BuiltTile {
        let content = self.content(terrain, tile, model, colors, proceed);
        BuiltTile { features: Vec::new(), content, is_of_plan: true }
    }

    /// Builds the content of a tile.
    fn content(
        &self,
        terrain: &PlannedTerrain,
        tile: &PlannedTile,
        model: TileModelOptions,
        colors: &dyn GroundColors,
        proceed: &(impl Fn() -> Result<()> + Sync),
    ) -> Result<TileContent> {
        proceed()?;
        let [west, south, east, north] = TileGrid::bounds(tile.id);
        let spacing = PlannedTerrain::spacing(tile.id.level);
        let corner = DVec2::new(west, south);
        let grid = SquareGrid { corner, spacing, heights: self.sample(corner, spacing, POINTS) };
        // Triangles are flat, and the earth is not.
        let bend = |spacing: f64| spacing * spacing / (4.0 * RADIUS);
        let finer = (tile.id.level < terrain.finest)
            .then(|| self.sample(corner, spacing / 2.0, 2 * POINTS - 1))
            .map_or(0.0, |finer| grid.distance(&finer) + bend(spacing));
        let margin = 0.05 + 2.0 * model.precision + 2.0 * bend(PlannedTerrain::spacing(terrain.coarsest));
        let sides = [(0, south), (0, north), (1, west), (1, east)];
        let depth = sides.map(|(axis, at)| self.drop_at_side(terrain, tile, axis, at));
        let depth = depth.into_iter().fold(0.0, f64::max) + margin;
        proceed()?;
        let paint = || {
            let square = (corner, east - west, PlannedTerrain::spacing(terrain.finest));
            GroundImage::paint(square, colors, |place| self.0.height(place), proceed)
        };
        let image = colors.uniform().is_none().then(paint).transpose()?;
        let material = match &image {
            Some(image) => image.material(1.0)?,
            None => {
                let [red, green, blue] = colors.uniform().unwrap_or_default();
                Material { base_color: [red, green, blue, 1.0], roughness: 1.0, ..Material::default() }
            }
        };
        let scene = self.scene(&grid, depth, &material, image.as_ref());
        Ok(TileContent { scene, model, errors: vec![finer], ..TileContent::default() })
    }

    /// Returns the heights of a square of `points` by `points`, row by row from the south.
    fn sample(&self, corner: DVec2, spacing: f64, points: usize) -> Vec<Option<f64>> {
        #[allow(clippy::cast_precision_loss, reason = "a tile has few points")]
        let at = |index: usize| index as f64 * spacing;
        let row = |y: usize| (0..points).map(move |x| self.height(corner.x + at(x), corner.y + at(y)));
        (0..points).flat_map(row).collect()
    }

    /// Returns the largest height (m) of a side of a tile above the same side in another level; `axis` is the direction of the side (0
    /// east, 1 north), and `at` its other coordinate.
    fn drop_at_side(&self, terrain: &PlannedTerrain, tile: &PlannedTile, axis: usize, at: f64) -> f64 {
        let bounds = TileGrid::bounds(tile.id);
        let (begin, end) = (bounds[axis], bounds[axis + 2]);
        let height = |along: f64| if axis == 0 { self.height(along, at) } else { self.height(at, along) };
        // Points of all levels are multiples of their spacings, which are powers of two.
        let profile = |spacing: f64, along: f64| {
            let first = (along / spacing).floor() * spacing;
            let part = (along - first) / spacing;
            let low = height(first)?;
            if part == 0.0 { Some(low) } else { Some(low + (height(first + spacing)? - low) * part) }
        };
        let own = PlannedTerrain::spacing(tile.id.level);
        let mut most: f64 = 0.0;
        for level in (terrain.coarsest..=terrain.finest).filter(|level| *level != tile.id.level) {
            let other = PlannedTerrain::spacing(level);
            let step = own.min(other);
            let mut along = begin;
            while along <= end {
                if let Some((a, b)) = profile(own, along).zip(profile(other, along)) {
                    most = most.max(a - b);
                }
                along += step;
            }
        }
        most
    }

    /// Returns the scene of a grid with skirts of a depth (m). Points have texture coordinates in `image`.
    fn scene(
        &self,
        grid: &SquareGrid,
        depth: f64,
        material: &Material,
        image: Option<&GroundImage>,
    ) -> Scene {
        let mut scene = Scene::default();
        let material = scene.material(material);
        let mut mesh = Mesh::default();
        let part = mesh.part(material);
        let half = grid.spacing * f64::from(PlannedTerrain::SQUARES) / 2.0;
        let middle = grid.corner + half;
        let mut builder = MeshBuilder { grid, numbers: vec![[None; 2]; POINTS * POINTS], points: Vec::new() };
        for y in 0..POINTS - 1 {
            for x in 0..POINTS - 1 {
                if grid.has_square(x, y) {
                    let [a, b, c, d] =
                        [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].map(|at| builder.number(at, 0));
                    part.triangles.push([a, b, c]);
                    part.triangles.push([a, c, d]);
                }
            }
        }
        for [from, to] in skirt_edges(grid) {
            let [a, b] = [from, to].map(|at| builder.number(at, 0));
            let [below_a, below_b] = [from, to].map(|at| builder.number(at, 1));
            part.triangles.push([below_a, below_b, b]);
            part.triangles.push([below_a, b, a]);
        }
        let mut normals = Vec::new();
        for ([x, y], row) in builder.points {
            let place = grid.place([x, y]);
            let height = grid.at(x, y).unwrap_or(0.0);
            let z = if row == 0 { height } else { height - depth };
            part.positions.push((place - middle).extend(z).as_vec3());
            part.uvs.push(image.map_or(Vec2::ZERO, |image| image.tex_coord(place)));
            normals.push(self.normal(place, height, grid.spacing));
        }
        for four in normals.chunks(4) {
            let axes = [0, 1, 2].map(|axis| {
                Vec4::from_array(std::array::from_fn(|it| four.get(it).map_or(0.0, |n| n[axis])))
            });
            part.normals.extend(Normal::four(axes).into_iter().take(four.len()));
        }
        if part.triangles.is_empty() {
            return Scene::default();
        }
        scene.meshes.push(mesh);
        scene.instances.push(Instance {
            mesh: 0,
            transform: DAffine3::from_translation(middle.extend(0.0)),
            name: "terrain".to_owned(),
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        });
        scene
    }

    /// Returns the normal of the terrain at a place, from heights at a distance (m).
    fn normal(&self, place: DVec2, height: f64, distance: f64) -> Vec3 {
        let slope = |step: DVec2| {
            let there = |side: f64| self.height(place.x + step.x * side, place.y + step.y * side);
            let (before, after) = (there(-1.0), there(1.0));
            let length =
                distance * f64::from(u8::from(before.is_some()) + u8::from(after.is_some())).max(1.0);
            (after.unwrap_or(height) - before.unwrap_or(height)) / length
        };
        DVec3::new(-slope(DVec2::X * distance), -slope(DVec2::Y * distance), 1.0).normalize().as_vec3()
    }
}

/// Heights of the points of a tile.
struct SquareGrid {
    /// Place (m) of the south-western point.
    corner: DVec2,
    /// Distance (m) between points.
    spacing: f64,
    /// Heights (m), row by row from the south; `None` outside the terrain.
    heights: Vec<Option<f64>>,
}

impl SquareGrid {
    fn at(&self, x: usize, y: usize) -> Option<f64> {
        self.heights.get(y * POINTS + x).copied().flatten()
    }

    fn place(&self, [x, y]: [usize; 2]) -> DVec2 {
        #[allow(clippy::cast_precision_loss, reason = "a tile has few points")]
        let steps = DVec2::new(x as f64, y as f64);
        self.corner + steps * self.spacing
    }

    /// Returns true if a square has heights at its corners.
    fn has_square(&self, x: usize, y: usize) -> bool {
        [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]].into_iter().all(|[x, y]| self.at(x, y).is_some())
    }

    /// Returns the largest distance (m) of the triangles from those of the grid with half the spacing: both are flat between the
    /// points of the finer one.
    fn distance(&self, finer: &[Option<f64>]) -> f64 {
        let fine = |x: usize, y: usize| finer.get(y * (2 * POINTS - 1) + x).copied().flatten();
        let mut most: f64 = 0.0;
        for y in 0..POINTS - 1 {
            for x in 0..POINTS - 1 {
                if !self.has_square(x, y) {
                    continue;
                }
                let of = |[[ax, ay], [bx, by]]: [[usize; 2]; 2]| {
                    let middle = self.at(ax, ay)?.midpoint(self.at(bx, by)?);
                    Some((fine(ax + bx, ay + by)? - middle).abs())
                };
                let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
                let all = [[a, b], [b, c], [d, c], [a, d], [a, c]].into_iter().filter_map(of);
                most = all.fold(most, f64::max);
            }
        }
        most
    }
}

/// Returns the edges at the sides of a tile, each with the outside to its right.
fn skirt_edges(grid: &SquareGrid) -> Vec<[[usize; 2]; 2]> {
    let last = POINTS - 1;
    let mut edges = Vec::new();
    for at in 0..last {
        let sides = [
            ([at, 0], [[at, 0], [at + 1, 0]]),
            ([last - 1, at], [[last, at], [last, at + 1]]),
            ([at, last - 1], [[at + 1, last], [at, last]]),
            ([0, at], [[0, at + 1], [0, at]]),
        ];
        edges.extend(sides.into_iter().filter(|([x, y], _)| grid.has_square(*x, *y)).map(|(_, edge)| edge));
    }
    edges
}

/// Numbers of the points in use.
struct MeshBuilder<'a> {
    grid: &'a SquareGrid,
    /// Numbers of each point and of the point below it in the skirt.
    numbers: Vec<[Option<u32>; 2]>,
    /// Points in use, each with 0, or with 1 in the skirt.
    points: Vec<([usize; 2], usize)>,
}

impl MeshBuilder<'_> {
    /// Returns the number of a point.
    fn number(&mut self, [x, y]: [usize; 2], row: usize) -> u32 {
        debug_assert!(self.grid.at(x, y).is_some());
        *self.numbers[y * POINTS + x][row].get_or_insert_with(|| {
            self.points.push(([x, y], row));
            u32::try_from(self.points.len() - 1).unwrap_or(u32::MAX)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::PlainGround;
    use super::*;
    use crate::plan::{PlannedFile, TileId};
    use burgeon_data::elevation::SampleGrid;
    use proptest::prelude::*;

    /// Returns hills with a sample each 20 m over 4 km, and their terrain.
    fn hills(seed: u32) -> (TerrainHeights, PlannedTerrain) {
        let side = 201;
        let height = |at: usize| {
            let (x, y) = ((at % side) as f64 / 9.0, (at / side) as f64 / 7.0);
            let rough = f64::from((at as u32 ^ seed).wrapping_mul(2_654_435_761) >> 24) / 64.0;
            (40.0 * x.sin() * y.cos() + 90.0 + rough) as f32
        };
        let heights = (0..side * side).map(height).collect();
        let grid = SampleGrid { first: [-2000.0, 2000.0], step: [20.0, 20.0] };
        let raster = Raster::new("hills", [side, side], heights, grid, None);
        let heights = TerrainHeights(Relief::new(Arc::new(raster), &mut None).unwrap());
        let file = PlannedFile { path: "hills".to_owned(), hash: String::new() };
        let terrain = PlannedTerrain::new(file, heights.area(), heights.step());
        (heights, terrain)
    }

    fn planned(id: TileId) -> PlannedTile {
        let (ids, data, hash) = (String::new(), String::new(), String::new());
        PlannedTile {
            id,
            features: 0,
            cost: 1.0,
            region: TileGrid::bounds(id),
            ids,
            data,
            hash,
            lod: None,
            tall: None,
        }
    }

    /// Returns the points (m) of a tile, and the triangles that are not in skirts.
    fn surface(heights: &TerrainHeights, terrain: &PlannedTerrain, id: TileId) -> (Vec<[DVec3; 3]>, f64) {
        let built =
            heights.build(terrain, &planned(id), TileModelOptions::default(), &PlainGround, &|| Ok(()));
        let built = built.content.unwrap();
        let Some(instance) = built.scene.instances.first() else { return (Vec::new(), built.errors[0]) };
        let part = &built.scene.meshes[0].parts[0];
        let place =
            |number: u32| instance.transform.transform_point3(part.positions[number as usize].as_dvec3());
        (part.triangles.iter().map(|corners| corners.map(place)).collect(), built.errors[0])
    }

    /// Returns the height of triangles with an area in the plan at a place, and the lowest height of skirts there.
    fn height_at(triangles: &[[DVec3; 3]], place: DVec2) -> Option<f64> {
        triangles.iter().find_map(|[a, b, c]| {
            let cross = |p: DVec3, q: DVec3| (q.truncate() - p.truncate()).perp_dot(place - p.truncate());
            let area = (b - a).truncate().perp_dot((c - a).truncate());
            let parts = [cross(*b, *c), cross(*c, *a), cross(*a, *b)].map(|part| part / area);
            let inside = area > 1e-6 && parts.iter().all(|part| *part >= -1e-9);
            inside.then(|| a.z * parts[0] + b.z * parts[1] + c.z * parts[2])
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(8))]
        #[test]
        fn the_error_of_a_tile_is_at_least_its_distance_from_the_finer_tiles(seed in 0..1000_u32) {
            let (heights, terrain) = hills(seed);
            let id = terrain.tile_ids()[0];
            prop_assert!(id.level < terrain.finest);
            let (coarse, error) = surface(&heights, &terrain, id);
            let mut most: f64 = 0.0;
            for child in id.children() {
                let (fine, _) = surface(&heights, &terrain, child);
                for point in fine.iter().flatten().step_by(97) {
                    let place = point.truncate();
                    if let Some((a, b)) = height_at(&coarse, place).zip(height_at(&fine, place)) {
                        most = most.max((a - b).abs());
                    }
                }
            }
            prop_assert!(most <= error + 1e-3 && most > error * 0.2, "{most} {error}");
        }
    }

    #[test]
    fn a_tile_that_may_not_proceed_fails_with_the_reason() {
        let (heights, terrain) = hills(3);
        let tile = planned(terrain.tile_ids()[0]);
        let stopped = || Err(burgeon_base::error::Error::cancellation("stopped"));
        let built = heights.build(&terrain, &tile, TileModelOptions::default(), &PlainGround, &stopped);
        assert_eq!(built.content.err().unwrap().message(), "stopped");
    }

    #[test]
    fn skirts_reach_the_neighbour_of_any_level() {
        let (heights, terrain) = hills(7);
        let ids = terrain.tile_ids();
        let mut compared = 0;
        for a in ids.iter().filter(|id| id.level >= terrain.finest - 1) {
            let [.., east, _] = TileGrid::bounds(*a);
            let [_, south, _, north] = TileGrid::bounds(*a);
            let (own, _) = surface(&heights, &terrain, *a);
            // Tiles of all levels that begin where this one ends.
            for b in ids.iter().filter(|b| {
                let [west, low, _, high] = TileGrid::bounds(**b);
                west == east && low < north && high > south
            }) {
                let (other, _) = surface(&heights, &terrain, *b);
                let lowest = |triangles: &[[DVec3; 3]], y: f64| {
                    let near = triangles
                        .iter()
                        .flatten()
                        .filter(|p| (p.x - east).abs() < 1e-3 && (p.y - y).abs() < 1e-3);
                    near.map(|p| p.z).fold(f64::INFINITY, f64::min)
                };
                let spacing = PlannedTerrain::spacing(a.level);
                let [_, low, _, high] = TileGrid::bounds(*b);
                for step in 0..=PlannedTerrain::SQUARES {
                    let y = south + f64::from(step) * spacing;
                    if !(low..=high).contains(&y) {
                        continue;
                    }
                    let [inside, outside] = [DVec2::new(east - 1e-7, y), DVec2::new(east + 1e-7, y)];
                    if let Some((a, b)) = height_at(&own, inside).zip(height_at(&other, outside)) {
                        // The skirt of the higher one reaches the lower one.
                        assert!(a <= b || lowest(&own, y) <= b, "a gap between {a} and {b}");
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 1000, "{compared}");
    }
}
