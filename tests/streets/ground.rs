//! Streets on hilly terrain: sidewalks meet both the queried and the displayed terrain.

use std::path::PathBuf;

use burgeon::kit::Vector;
use burgeon::objects::{Network, Terrain};
use burgeon::scene::{Mesh, Scene};
use burgeon::script::RunOptions;
use glam::{DVec2, DVec3};

/// Distance (m) outside the sidewalk at which the terrain is sampled.
const BESIDE: f64 = 0.1;

/// Triangles of the displayed terrain, by square.
struct ShownGround {
    squares: std::collections::HashMap<[i64; 2], Vec<[DVec3; 3]>>,
}

const SQUARE: f64 = 4.0;

impl ShownGround {
    /// Collects the triangles of the terrain's meshes.
    #[allow(clippy::cast_possible_truncation, reason = "places of a town")]
    fn new(scene: &Scene) -> Self {
        let mut squares: std::collections::HashMap<[i64; 2], Vec<[DVec3; 3]>> = Default::default();
        for instance in &scene.instances {
            let mesh: &Mesh = &scene.meshes[instance.mesh];
            // The name of a tile consists of its level, row and column.
            if mesh.name.split(' ').next_back().is_none_or(|place| place.split('/').count() != 3) {
                continue;
            }
            let Some(part) = mesh.parts.first() else { continue };
            for corners in &part.triangles {
                let triangle = corners.map(|corner| {
                    instance.transform.transform_point3(part.positions[corner as usize].as_dvec3())
                });
                let [low, high] = triangle[1..]
                    .iter()
                    .fold([triangle[0]; 2], |[low, high], at| [low.min(*at), high.max(*at)]);
                for x in (low.x / SQUARE).floor() as i64..=(high.x / SQUARE).floor() as i64 {
                    for y in (low.y / SQUARE).floor() as i64..=(high.y / SQUARE).floor() as i64 {
                        squares.entry([x, y]).or_default().push(triangle);
                    }
                }
            }
        }
        Self { squares }
    }

    /// Returns the height (m) of the terrain at a position; `None` where no terrain is displayed.
    #[allow(clippy::cast_possible_truncation, reason = "places of a town")]
    fn height(&self, at: DVec2) -> Option<f64> {
        let square = [(at.x / SQUARE).floor() as i64, (at.y / SQUARE).floor() as i64];
        self.squares.get(&square)?.iter().find_map(|[a, b, c]| {
            let [u, v, w] = [b - a, c - a, at.extend(0.0) - a].map(DVec3::truncate);
            let area = u.perp_dot(v);
            let (s, t) = (w.perp_dot(v) / area, u.perp_dot(w) / area);
            (s >= -1e-6 && t >= -1e-6 && s + t <= 1.0 + 1e-6)
                .then_some(a.z + s * (b.z - a.z) + t * (c.z - a.z))
        })
    }
}

/// Heights of sidewalks above the terrain just outside, as queried and as displayed; and the number of positions at
/// which the terrain is displayed within streets.
#[derive(Default)]
struct Floats {
    queried: Vec<f64>,
    shown: Vec<f64>,
    within: usize,
    inside: usize,
}

fn measured(script: &str, seed: u64, set: &[(&str, &str)], floats: &mut Floats) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts").join(script);
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let run = burgeon::run(&path, RunOptions { seed, params: set.into(), lod: 0, ..burgeon::options() })
        .unwrap_or_else(|error| panic!("{script}, seed {seed}: {error}"));
    let objects = || {
        run.systems.iter().flat_map(|system| &system.objects).map(|object| {
            let any: &dyn std::any::Any = &**object;
            any
        })
    };
    let grown = objects().find_map(|object| object.downcast_ref::<Network>()).expect("a network");
    // The first terrain is the one without streets.
    let land =
        objects().filter_map(|object| object.downcast_ref::<Terrain>()).next_back().expect("a terrain");
    let shown = ShownGround::new(&run.scene);
    let network = grown.network();
    for (piece, known) in network.pieces().filter(|(_, known)| !known.is_bridge) {
        let [start, stop] = network.line(piece);
        let (way, length, half) =
            ((stop - start).normalize(), start.distance(stop), known.attributes.width / 2.0);
        let clear = 2.0 * known.attributes.width + 6.0;
        let mut along = clear;
        while along < length - clear {
            for side in [-1.0, 1.0] {
                let at = |aside: f64| start + way * along + way.perp() * side * aside;
                let height = |at: DVec2| grown.height(Vector(at.extend(0.0))).expect("a height");
                let outside = at(half + BESIDE);
                let is_free = network.pieces().all(|(other, of)| {
                    let [a, b] = network.line(other);
                    let (way, part) = (b - a, (outside - a).dot(b - a) / (b - a).length_squared());
                    other == piece
                        || outside.distance(a + way * part.clamp(0.0, 1.0)) > of.attributes.width / 2.0 + 1.0
                });
                if is_free {
                    let sidewalk = height(at(half));
                    let ground = land.height(Vector(outside.extend(0.0))).expect("a height");
                    floats.queried.push(sidewalk - ground);
                    // A hole in the terrain has no height.
                    floats
                        .shown
                        .push(shown.height(outside).map_or(f64::INFINITY, |ground| sidewalk - ground));
                    floats.inside += 2;
                    floats.within += usize::from(shown.height(at(half - 0.05)).is_some());
                    floats.within += usize::from(shown.height(at(0.3 * half)).is_some());
                }
            }
            along += 7.0;
        }
    }
}

/// Returns the median, the 95th percentile and the maximum of the absolute values.
fn spread(floats: &mut [f64]) -> [f64; 3] {
    floats.iter_mut().for_each(|float| *float = float.abs());
    floats.sort_by(f64::total_cmp);
    [floats.len() / 2, floats.len() * 95 / 100, floats.len() - 1].map(|index| floats[index])
}

#[test]
fn sidewalks_meet_the_ground_of_hilly_villages() {
    let mut floats = Floats::default();
    for (seed, hills) in [(1, "26"), (2, "26"), (3, "40"), (4, "50"), (5, "12"), (6, "33")] {
        measured("village.lua", seed, &[("hills", hills), ("trees", "false")], &mut floats);
    }
    let Floats { mut queried, mut shown, within, inside } = floats;
    let count = queried.len();
    let (queried, shown) = (spread(&mut queried), spread(&mut shown));
    println!("{count} places: queried {queried:.3?}, shown {shown:.3?}, {within} of {inside} within");
    assert!(count > 1000, "{count}");
    assert!(queried[1] < 0.15 && shown[1] < 0.15, "{queried:.3?} {shown:.3?}");
    assert_eq!(within, 0, "of {inside}");
}
