//! Tests of all kinds of roof over random plans: each is a closed solid without faces that have no area.

use std::f64::consts::TAU;

use burgeon_base::random::Stream;
use burgeon_geometry::solid;
use burgeon_scene::Part;
use burgeon_shapes::Shape;
use glam::DVec2;

use super::direction::CompassDirection;
use super::kinds::{KINDS, roof_shape};
use super::options::Roof;
use burgeon_kit::{Parameter, Value};

/// Minimum area (m²) of a face.
const LEAST: f64 = 1e-7;

/// Returns a random plan: convex, an L, a U or a T, turned and moved, with a courtyard in every other one.
fn plan(random: &mut Stream, family: usize) -> Vec<Vec<DVec2>> {
    let mut size = |from: f64, to: f64| {
        let size = from + (to - from) * random.uniform();
        // Equal measures make ridges of wings meet in one point.
        if random.below(2) == 0 { size.round() } else { size }
    };
    let (width, depth, wing, notch) = (size(10.0, 24.0), size(9.0, 20.0), size(3.0, 3.9), size(1.0, 4.0));
    let [w, d, a, n] = [width, depth, wing, notch];
    let points: Vec<(f64, f64)> = match family {
        0 => vec![(0., 0.), (w, 0.), (w, d), (0., d)],
        1 => vec![(0., 0.), (w, 0.), (w, a), (a, a), (a, d), (0., d)],
        2 => vec![(0., 0.), (w, 0.), (w, d), (w - a, d), (w - a, a), (a, a), (a, d), (0., d)],
        3 => vec![(0., 0.), (w, 0.), (w, a), (a + n, a), (a + n, d), (n, d), (n, a), (0., a)],
        _ => {
            let count = 3 + random.below(8);
            let angle = |corner: usize| TAU * corner as f64 / count as f64;
            (0..count).map(|corner| (w / 2.0 * angle(corner).cos(), d / 2.0 * angle(corner).sin())).collect()
        }
    };
    let mut rings = vec![points];
    if family == 0 && random.below(2) == 0 {
        let (x, y, b) = (w / 3.0, d / 3.0, 1.0 + random.uniform());
        rings.push(vec![(x, y), (x, y + b), (x + b, y + b), (x + b, y)]);
    }
    let turn = if random.below(3) == 0 { DVec2::X } else { DVec2::from_angle(TAU * random.uniform()) };
    let off = DVec2::new(random.uniform(), random.uniform()) * 50.0;
    rings
        .into_iter()
        .map(|ring| ring.into_iter().map(|at| turn.rotate(DVec2::from(at)) + off).collect())
        .collect()
}

/// Returns the number of rounds, multiplied by the environment variable `BURGEON_CASES` if it is set.
fn rounds() -> usize {
    let times = std::env::var("BURGEON_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1);
    KINDS.len() * 60 * times
}

/// Describes the defects of a roof; `None` if it is a solid.
fn defects(shape: &Shape) -> Option<String> {
    let mesh = shape.mesh();
    if let Some(face) = mesh.faces.iter().find(|face| mesh.area_vector(face).length() < LEAST) {
        return Some(format!("a face of {} m²", mesh.area_vector(face).length()));
    }
    let mut part = Part { positions: mesh.points.iter().map(|at| at.as_vec3()).collect(), ..Part::default() };
    for face in &mesh.faces {
        match mesh.triangles(face) {
            Ok(triangles) => part.triangles.extend(triangles),
            Err(_) => {
                let at = |ring: &Vec<u32>| ring.iter().map(|point| mesh.at(*point)).collect::<Vec<_>>();
                let rings: Vec<_> = face.rings.iter().map(at).collect();
                return Some(format!("a face that cannot be divided into triangles, {rings:?}"));
            }
        }
    }
    let check = solid::check([&part]);
    (!check.is_solid() || !shape.is_closed()).then(|| format!("{check:?}"))
}

#[test]
fn every_kind_with_overhang_direction_and_height_is_a_closed_solid_over_random_plans() {
    let mut random = Stream::new(17);
    let (mut failed, mut count) = (Vec::new(), 0);
    for round in 0..rounds() {
        let kind = KINDS[round % KINDS.len()];
        let rings = plan(&mut random, round / KINDS.len() % 5);
        let overhang = [0.0, 0.05, 0.3, 0.8][random.below(4)];
        let height = [None, Some(0.3), Some(2.0), Some(4.5), Some(12.0)][random.below(5)];
        let direction = match random.below(3) {
            0 => None,
            1 => Some(Value::Text("SSE".into())),
            _ => Some(Value::Number(360.0 * random.uniform())),
        };
        let direction = direction.and_then(|value| CompassDirection::from_value(value).ok());
        let slope = [None, Some(20.0), Some(65.0)][random.below(3)];
        let mut options = Roof { kind: kind.into(), height, slope, overhang, direction, ..Roof::default() };
        // Some kinds have neither a direction nor an overhang.
        if roof_shape(&options).is_err() {
            options.direction = None;
        }
        if roof_shape(&options).is_err() {
            options.overhang = 0.0;
        }
        let roof = roof_shape(&options).unwrap_or_else(|error| panic!("{kind}: {error}"));
        let face = Shape::plan(&rings, 3.0).expect("a plan");
        count += 1;
        match face.roof(&roof, None) {
            Ok(made) => {
                if let Some(defect) = defects(&made.shape) {
                    failed.push(format!("{round} {roof:?}: {defect} over {rings:?}"));
                }
            }
            Err(error) => failed.push(format!("{round} {roof:?}: {error} over {rings:?}")),
        }
    }
    assert!(failed.is_empty(), "{} of {count}:\n{}", failed.len(), failed.join("\n"));
}
