//! Checks of terrain over random measured heights: the ground is exact at every sample, and so are its
//! triangles if the cells are small enough.

use std::collections::HashMap;
use std::sync::Arc;

use burgeon::objects::Elevation;
use burgeon::random::Stream;
use burgeon::scene::Part;
use burgeon::terrain::{
    DivisionRules, Edit, Edits, Ground, GroundCuts, GroundMesh, HeightSource, LevelRules, NumberRange,
    Quadrants, RuleTable, Tables, TileRing, View, World,
};
use burgeon_data::elevation::{Raster, Relief, SampleGrid};
use burgeon_rewriting::ModuleKey;
use burgeon_spatial::{Crs, ReferenceFrame};
use glam::{DVec2, DVec3};

/// Maximum distances of the ground and of its triangles from the samples (m).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Worst {
    pub ground: f64,
    pub triangles: f64,
    pub samples: usize,
}

/// Random numbers of a case.
struct RandomSource(Stream);

impl RandomSource {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    fn below(&mut self, most: usize) -> usize {
        self.0.below(most)
    }

    fn odds(&mut self, chance: f64) -> bool {
        self.0.uniform() < chance
    }
}

/// Checks case number `seed`; fails with a description of the defect.
pub(crate) fn check(seed: u64) -> Result<Worst, String> {
    let mut luck = RandomSource(Stream::new(seed));
    let relief = relief(&mut luck);
    let elevation = Elevation::new(Arc::new(relief));
    let (low, high) = (elevation.low().truncate(), elevation.high().truncate());
    let step = elevation.step();
    // A square within the raster, which may be rotated relative to it: its corners may not be covered.
    let whole = (high - low).min_element();
    let aligned = luck.odds(0.3);
    let mut size = whole * luck.between(0.3, 0.68);
    let mut corner =
        low.midpoint(high) - size / 2.0 + DVec2::new(luck.between(-0.1, 0.1), luck.between(-0.1, 0.1)) * size;
    if aligned {
        // Cells as large as samples, half or twice as large, with samples at their corners or centres.
        let level = 1 << (1 + luck.below(4));
        size = (f64::from(level) * step).min(whole / 2.0);
        let first = elevation.samples(corner, corner + size);
        let Some(first) = first.first() else { return Ok(Worst::default()) };
        corner = *first - if luck.odds(0.5) { DVec2::ZERO } else { DVec2::splat(step / 2.0) };
    }
    let covered = |at: DVec2| elevation.height_at(at).is_some();
    if ![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].into_iter().all(|part| covered(corner + part * size)) {
        return Ok(Worst::default());
    }
    let world = Arc::new(world(&mut luck, elevation.clone(), corner, size));
    let mut ground = Ground::new(Arc::clone(&world));
    let most = ((size / step).log2().max(0.0) as u32 + 3).min(8);
    let view = if luck.odds(0.7) {
        View::whole(&world, luck.below(most as usize + 1) as u32)
    } else {
        let levels = 2 + luck.below(most.max(3) as usize - 2) as u32;
        let ring = |(across, levels)| TileRing { across, levels };
        View { cell: size / 4.0, rings: [(2, levels), (4, levels / 2)].map(ring).to_vec() }
    };
    let edited = luck.odds(0.1);
    if edited {
        let mut edits = Edits::default();
        let outline =
            [(0.2, 0.2), (0.4, 0.2), (0.4, 0.4)].map(|(x, y)| (corner + DVec2::new(x, y) * size).to_array());
        let edit = Edit::Flatten { outline: outline.to_vec(), height: 5.0, margin: size / 50.0 };
        edits.add(&world, edit).map_err(|error| error.to_string())?;
        ground.edit(&Arc::new(edits));
    }
    ground.focus(corner + size * 0.5, &view, &Tables).map_err(|error| error.to_string())?;
    let error = if luck.odds(0.7) { 0.0 } else { luck.between(0.0, 2.0) };
    measure(&ground, &elevation, (corner, size), error, edited).map_err(|what| {
        format!("case {seed}: {what}; {size} m with samples every {step} m, {view:?}, error {error}")
    })
}

/// Returns random heights, in metres or in other coordinates.
fn relief(luck: &mut RandomSource) -> Relief {
    let (columns, rows) = (4 + luck.below(40), 4 + luck.below(40));
    let step = 10f64.powf(luck.between(-0.5, 1.8));
    let ratio = if luck.odds(0.6) { 1.0 } else { luck.between(0.5, 2.0) };
    let kind = luck.below(3);
    let wide = luck.between(2.0, 12.0);
    let mut heights = Vec::new();
    for index in 0..columns * rows {
        let (x, y) = ((index % columns) as f64 / wide, (index / columns) as f64 / wide);
        let height = match kind {
            0 => (x.sin() + (1.7 * y).cos()) * step * 3.0,
            1 => luck.between(-1.0, 1.0) * step,
            _ => {
                if (x + y) as i64 % 2 == 0 {
                    4.0 * step
                } else {
                    luck.between(0.0, 0.1) * step
                }
            }
        };
        heights.push((height + 300.0) as f32);
    }
    let (crs, first, unit) = match luck.below(3) {
        0 => (None, [luck.between(-1e5, 1e5), luck.between(-1e5, 1e5)], [1.0; 2]),
        1 => (Some(32632), [360_000.0 + luck.between(0.0, 1e4), 4.85e6], [1.0; 2]),
        _ => (Some(4326), [luck.between(5.0, 10.0), luck.between(-60.0, 60.0)], [9e-6; 2]),
    };
    let grid = SampleGrid { first, step: [step * unit[0], step * ratio * unit[1]] };
    let crs = crs.map(|code| Crs::epsg(code).unwrap());
    // Another source may have defined the projection.
    let middle = match &crs {
        Some(crs) if crs.is_geographic() => [first[0] - 0.3, first[1]],
        _ => [7.5, 43.7],
    };
    let mut frame =
        (luck.odds(0.8)).then(|| ReferenceFrame::around(&Crs::epsg(4326).unwrap(), middle, "a").unwrap());
    let raster = Raster::new("a", [columns, rows], heights, grid, crs);
    Relief::new(Arc::new(raster), &mut frame).unwrap()
}

fn world(luck: &mut RandomSource, elevation: Elevation, corner: DVec2, size: f64) -> World {
    let undivided = LevelRules {
        from: 0,
        rules: DivisionRules::None,
        start: 0,
        height: 0.0,
        rest: Vec::new(),
        names: Arc::default(),
    };
    let mut layers = vec![undivided.clone()];
    if luck.odds(0.6) {
        let change = |low: f64| NumberRange { low, high: low + 1.0 };
        let rule = Quadrants {
            weight: 1.0,
            symbols: [0; 4],
            change: [change(-1.0), change(0.0), change(-0.5), change(-0.2)],
            decay: [NumberRange::exactly(0.6); 4],
        };
        let table = RuleTable { names: vec!["A".into()], rules: vec![vec![rule]] };
        let from = ((size / elevation.step()).log2().max(0.0).ceil() as u32).max(1);
        let decay = if luck.odds(0.5) { 200.0 } else { luck.between(0.1, 5.0) };
        layers.push(LevelRules {
            from,
            rules: DivisionRules::Table(Arc::new(table)),
            rest: vec![decay],
            ..undivided
        });
    }
    World {
        corner,
        size,
        layers,
        smooth: luck.odds(0.7),
        key: Some(ModuleKey::seed(3)),
        remap: Vec::new(),
        measured: Some(Arc::new(elevation)),
    }
}

fn measure(
    ground: &Ground,
    elevation: &Elevation,
    (corner, size): (DVec2, f64),
    error: f64,
    edited: bool,
) -> Result<Worst, String> {
    let world = ground.world();
    let mut worst = Worst::default();
    let mesh = GroundMesh::new(ground, error);
    // Only heights are tested for a tile that cannot show samples.
    let mut shown: Vec<DVec3> = Vec::new();
    for tile in ground.tiles() {
        let (low, across) = tile.bounds(world);
        for place in elevation.samples(low, low + across) {
            let expected = elevation.height_at(place).ok_or("a sample outside")?;
            // A point on the boundary may be outside by its rounding error.
            let within = place.clamp(corner, corner + size);
            let height = ground.height(within).ok_or("no height")?;
            if !edited {
                worst.ground = worst.ground.max((height - expected).abs());
            }
            worst.samples += 1;
            let near = across * 1e-6;
            let inside = place.cmpgt(low + near).all() && place.cmplt(low + across - near).all();
            if world.shows_samples(tile.level()) && inside {
                shown.push(place.extend(height));
            }
        }
    }
    let bucket = |at: DVec2| {
        let part = (at - corner) / size * 64.0;
        (part.x.floor() as i64, part.y.floor() as i64)
    };
    let mut buckets: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    for (index, sample) in shown.iter().enumerate() {
        buckets.entry(bucket(sample.truncate())).or_default().push(index);
    }
    // Positions are stored in f32, and samples near a side or a corner count as on it; on a slope this
    // changes the height.
    let moved = 2.5e-4 + size * 5e-7;
    let mut best = vec![f64::INFINITY; shown.len()];
    let mut area = 0.0;
    let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    let mut part = Part::default();
    let origin = corner.extend(0.0);
    for number in 0..ground.tiles().len() {
        mesh.write(number, origin, 0.0, &GroundCuts::default(), &mut part);
    }
    for corners in &part.triangles {
        let points = corners.map(|corner| part.positions[corner as usize]);
        let bits = points.map(|at| at.to_array().map(f32::to_bits));
        for [from, to] in [[bits[0], bits[1]], [bits[1], bits[2]], [bits[2], bits[0]]] {
            *edges.entry([from, to]).or_default() += 1;
            *edges.entry([to, from]).or_default() -= 1;
        }
        let [a, b, c] = points.map(|at| at.as_dvec3() + origin);
        let normal = (b - a).cross(c - a);
        if normal.z <= 0.0 {
            return Err(format!("a triangle of the area {} at {a} {b} {c}", normal.z / 2.0));
        }
        area += normal.z / 2.0;
        let (low, high) = (bucket(a.min(b).min(c).truncate()), bucket(a.max(b).max(c).truncate()));
        for x in low.0..=high.0 {
            for y in low.1..=high.1 {
                for &index in buckets.get(&(x, y)).into_iter().flatten() {
                    let at = shown[index];
                    let inside = [(a, b), (b, c), (c, a)].iter().all(|(from, to)| {
                        let side = (to - from).truncate();
                        side.perp_dot((at - from).truncate()) >= -moved * side.length()
                    });
                    if inside {
                        let plane = a.z - normal.truncate().dot((at - a).truncate()) / normal.z;
                        let slope = normal.truncate().length() / normal.z;
                        let off = (plane - at.z).abs() - error - moved * slope;
                        best[index] = best[index].min(off);
                    }
                }
            }
        }
    }
    worst.triangles = best.iter().fold(0.0, |worst: f64, off| worst.max(*off));
    if worst.ground > 1e-3 {
        return Err(format!("the ground is {} m from a sample", worst.ground));
    }
    if worst.triangles > 1e-3 {
        return Err(format!("triangles are {} m from a sample", worst.triangles));
    }
    if (area - size * size).abs() > 1e-4 * area {
        return Err(format!("triangles cover {area} of {} m2", size * size));
    }
    check_gaps(&edges, size as f32)?;
    Ok(worst)
}

/// Fails if an edge inside a square of this size has different numbers of triangles in both directions.
fn check_gaps(edges: &HashMap<[[u32; 3]; 2], i32>, size: f32) -> Result<(), String> {
    for (edge, _) in edges.iter().filter(|(_, count)| **count != 0) {
        let on = |axis: usize, rim: f32| {
            edge.iter().all(|end| (f32::from_bits(end[axis]) - rim).abs() < 1e-5 * size + 2e-4)
        };
        if !(0..2).any(|axis| on(axis, 0.0) || on(axis, size)) {
            return Err(format!("a gap at {:?}", edge.map(|end| end.map(f32::from_bits))));
        }
    }
    Ok(())
}
