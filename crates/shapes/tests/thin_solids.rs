//! Unions of thin solids whose faces almost coincide.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]
#![allow(clippy::float_cmp, reason = "a solid that is not moved has a shift of exactly 0")]

use burgeon_shapes::{Shape, SolidOperation};
use glam::{DVec2, DVec3};

/// Numbers from 0 to 1, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1u32 << 31)
    }

    fn below(&mut self, count: f64) -> f64 {
        (self.next() * count).floor()
    }
}

/// Returns an upright prism with a regular outline around the centre of the unit square.
fn prism(sides: u32, height: f64) -> Shape {
    let corner = |side: u32| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
        DVec2::new(angle.cos(), angle.sin()) * 0.5 + 0.5
    };
    let ring: Vec<DVec2> = (0..sides).map(corner).collect();
    Shape::plan(&[ring], 0.0).unwrap().extrude(height, None).unwrap()
}

/// Returns a slice of 1 mm: turned a little, shifted by whole slices, or upright at an angle of whole steps.
fn slice(number: u32, numbers: &mut Numbers) -> Shape {
    let (thin, height) = (0.001, f64::from(number) * 0.001);
    match numbers.below(5.0) as u32 {
        0 => Shape::cuboid(DVec3::new(1.0, 1.0, thin))
            .rotate(DVec3::ZERO, DVec3::X, numbers.next() * 2e-5)
            .translate(DVec3::Z * height * 0.9),
        1 => prism(48, thin).translate(DVec3::Z * height),
        2 => Shape::cuboid(DVec3::new(1.0, thin, 1.0)).rotate(
            DVec3::new(0.5, 0.5, 0.0),
            DVec3::Z,
            numbers.below(12.0) * std::f64::consts::PI / 12.0,
        ),
        3 => Shape::cuboid(DVec3::new(thin, 1.0, 1.0)).translate(DVec3::X * numbers.below(20.0) * thin),
        _ => prism(16, 0.02).translate(DVec3::new(numbers.next() * 1e-6, 0.0, numbers.next() * 1e-9)),
    }
}

/// Half spaces of a convex solid: the outer normal of each face, and its distance (m) from the origin.
fn half_spaces(solid: &Shape) -> Vec<(DVec3, f64)> {
    let mesh = solid.mesh();
    let space = |face| {
        let normal = mesh.normal(face);
        (normal, normal.dot(mesh.centroid(face).0))
    };
    mesh.faces.iter().map(space).collect()
}

/// Returns the volume (m³) of the union of convex solids around the unit square, without set operations: from the lengths of
/// upright lines inside of any solid.
///
/// Method: the additive recurrence of the plastic number, M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
fn volume_of_lines(solids: &[Shape]) -> f64 {
    const LINES: u32 = 400_000;
    const SIDE: f64 = 1.5;
    let solids: Vec<_> = solids.iter().map(|solid| (half_spaces(solid), solid.bounds())).collect();
    let mut sum = 0.0;
    for line in 0..LINES {
        let at =
            [0.754_877_666_246_693, 0.569_840_290_998_053_3].map(|step| (f64::from(line) * step).fract());
        let at = (DVec2::from(at) * SIDE - 0.25).extend(0.0);
        let inside = |[low, high]: &[DVec3; 2]| {
            low.truncate().cmple(at.truncate()).all() && high.truncate().cmpge(at.truncate()).all()
        };
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for (spaces, bounds) in solids.iter().filter(|(_, bounds)| inside(bounds)) {
            let mut span = [bounds[0].z, bounds[1].z];
            for (normal, distance) in spaces {
                let rest = distance - normal.dot(at);
                match normal.z {
                    z if z > 1e-12 => span[1] = span[1].min(rest / z),
                    z if z < -1e-12 => span[0] = span[0].max(rest / z),
                    _ if rest < 0.0 => span[1] = f64::NEG_INFINITY,
                    _ => {}
                }
            }
            if span[0] < span[1] {
                spans.push(span);
            }
        }
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut end = f64::NEG_INFINITY;
        for [from, to] in spans {
            sum += (to - from.max(end)).max(0.0);
            end = end.max(to);
        }
    }
    sum * SIDE * SIDE / f64::from(LINES)
}

#[test]
fn unions_of_forty_thin_slices_succeed_unmoved_and_have_the_right_volume() {
    for seed in 0..12 {
        let mut numbers = Numbers(seed);
        let mut parts = vec![slice(0, &mut numbers)];
        let mut whole = parts[0].clone();
        for number in 1..40 {
            let part = slice(number, &mut numbers);
            let union = whole.combine(&part, SolidOperation::Union).unwrap();
            assert!(union.shift == 0.0, "seed {seed}, slice {number}");
            whole = union.solid.unwrap();
            assert!(whole.is_closed(), "seed {seed}, slice {number}");
            let mesh = whole.mesh();
            assert!(
                mesh.faces.iter().all(|face| mesh.triangles(face).is_ok()),
                "seed {seed}, slice {number}"
            );
            parts.push(part);
        }
        // The lines have an error of their own.
        let (found, expected) = (whole.volume(), volume_of_lines(&parts));
        assert!((found - expected).abs() < 0.01 * expected, "{found} m³, not {expected} m³, seed {seed}");
        assert!(whole.body.faces() < 6000, "{} faces, seed {seed}", whole.body.faces());
    }
}

/// Boxes on a lattice, as the numbers of their first and last cells along each axis.
type LatticeBox = [[usize; 2]; 3];

/// Returns the number of cells that any of the boxes covers.
fn covered_cells(boxes: &[LatticeBox], count: usize) -> usize {
    let inside = |cell: usize, span: [usize; 2]| (span[0]..span[1]).contains(&cell);
    let cells =
        (0..count * count * count).map(|cell| [cell % count, cell / count % count, cell / count / count]);
    cells.filter(|cell| boxes.iter().any(|spans| (0..3).all(|axis| inside(cell[axis], spans[axis])))).count()
}

#[test]
fn unions_of_thin_boxes_on_a_lattice_have_the_exact_volume_also_if_they_almost_miss_it() {
    const COUNT: usize = 24;
    const CELL: f64 = 0.001;
    for (seed, error) in [(1, 0.0), (2, 0.0), (3, 1e-10), (4, 1e-9), (5, 1e-8), (6, 1e-7)] {
        let mut numbers = Numbers(seed);
        let mut boxes: Vec<LatticeBox> = Vec::new();
        let mut whole: Option<Shape> = None;
        for number in 0..30 {
            // A plate of one cell across one of the axes.
            let spans: LatticeBox = std::array::from_fn(|axis| {
                if axis == number % 3 {
                    let from = numbers.below(COUNT as f64) as usize;
                    return [from, from + 1];
                }
                let from = numbers.below(COUNT as f64 / 2.0) as usize;
                [from, from + 1 + numbers.below(COUNT as f64 / 2.0) as usize]
            });
            let [low, high] = [0, 1].map(|end| DVec3::from_array(spans.map(|span| span[end] as f64 * CELL)));
            let miss = DVec3::new(numbers.next(), numbers.next(), numbers.next()) * error;
            let part = Shape::cuboid(high - low).translate(low + miss);
            boxes.push(spans);
            let union = match &whole {
                Some(whole) => whole.combine(&part, SolidOperation::Union).unwrap(),
                None => part.combine(&part, SolidOperation::Union).unwrap(),
            };
            assert!(union.shift == 0.0);
            let solid = union.solid.unwrap();
            let exact = covered_cells(&boxes, COUNT) as f64 * CELL.powi(3);
            // Each side of a plate is off by the error at most.
            let most = 1e-9 * exact + 2.0 * error * solid.area();
            assert!(solid.is_closed(), "seed {seed}, {number}");
            assert!(
                (solid.volume() - exact).abs() <= most,
                "{} m³, not {exact} m³, seed {seed}, {number}",
                solid.volume()
            );
            whole = Some(solid);
        }
    }
}

#[test]
fn fifty_slices_on_each_other_are_one_block() {
    for gap in [0.0, 1e-10, -1e-10] {
        let slice = |number: u32| {
            let size = DVec3::new(1.0, 1.0, 0.001);
            Shape::cuboid(size).translate(DVec3::Z * f64::from(number) * (0.001 + gap))
        };
        let mut whole = slice(0);
        for number in 1..50 {
            whole = whole.combine(&slice(number), SolidOperation::Union).unwrap().solid.unwrap();
        }
        assert!(whole.is_closed() && (whole.volume() - 0.05).abs() < 1e-7, "{gap}: {}", whole.volume());
    }
}
