//! Properties of operations on random solids: volumes, areas, closedness and orientation.

use std::f64::consts::TAU;

use burgeon_geometry::solid;
use burgeon_scene::Part;
use burgeon_shapes::{CutPlane, PartSize, PartSizes, Selector, Shape, SizedParts, SolidOperation, SplitAxis};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

/// Returns a plan whose outline is a star around the origin, with or without a hole, on a coarse lattice so that
/// points often lie on planes of cuts.
fn plan(radii: &[f64], hole: bool, lattice: bool) -> Shape {
    let place = |index: usize, radius: f64| {
        let at = DVec2::from_angle(TAU * index as f64 / radii.len() as f64) * radius;
        if lattice { at.round() } else { at }
    };
    let mut outline: Vec<DVec2> =
        radii.iter().enumerate().map(|(index, radius)| place(index, 4.0 + radius)).collect();
    outline.dedup();
    let mut rings = vec![outline];
    if hole {
        rings.push([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(DVec2::from).to_vec());
    }
    Shape::plan(&rings, 1.0).expect("a valid plan")
}

fn solids() -> impl Strategy<Value = Shape> {
    (proptest::collection::vec(0.0..6.0f64, 5..14), any::<bool>(), any::<bool>(), 0.5..5.0f64, 0..3u8)
        .prop_map(|(radii, hole, lattice, height, kind)| {
            let face = plan(&radii, hole, lattice);
            match kind {
                0 => face.extrude(height, None),
                1 => face.extrude(-height, Some(DVec3::new(0.3, 0.2, 1.0))),
                _ => face.taper(height, 0.4),
            }
            .expect("a solid")
        })
}

/// Checks a solid by its triangles, independently of its polygons.
fn check(shape: &Shape) -> Result<f64, TestCaseError> {
    let mesh = shape.mesh();
    let mut part = Part { positions: mesh.points.iter().map(|at| at.as_vec3()).collect(), ..Part::default() };
    for face in &mesh.faces {
        let normal = mesh.normal(face);
        for corners in mesh.triangles(face).map_err(|error| TestCaseError::fail(error.to_string()))? {
            let [a, b, c] = corners.map(|corner| mesh.at(corner));
            prop_assert!((b - a).cross(c - a).dot(normal) > 0.0, "a triangle is turned");
            part.triangles.push(corners);
        }
    }
    let found = solid::check([&part]);
    prop_assert!(
        found.is_closed(),
        "{} open and {} inverted edges",
        found.open.len(),
        found.inconsistent.len()
    );
    prop_assert!(shape.is_closed());
    let volume = solid::volume([&part]);
    prop_assert!((volume - shape.volume()).abs() < 1e-3 * (1.0 + volume), "{volume} {}", shape.volume());
    Ok(shape.volume())
}

/// Returns true if a plane is that of a face of a solid, whatever its direction.
fn lies_on(at: DVec3, normal: DVec3, solid: &Shape) -> bool {
    let mesh = solid.mesh();
    mesh.faces.iter().any(|face| {
        let own = mesh.normal(face);
        own.dot(normal).abs() > 1.0 - 1e-6 && own.dot(at - mesh.centroid(face).0).abs() < 1e-5
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_parts_of_a_cut_are_closed_and_add_up(
        solid in solids(), angle in 0..8u8, tilt in 0..3u8, offset in -6..7i8, free in prop::option::of(-5.0..5.0f64),
    ) {
        let turn = TAU * f64::from(angle) / 8.0;
        let normal = DVec3::new(turn.cos(), turn.sin(), f64::from(tilt) * 0.5).normalize();
        let normal = if free.is_some() { DVec3::new(turn.sin(), 0.31, turn.cos()).normalize() } else { normal };
        let plane = CutPlane { normal, offset: free.unwrap_or(f64::from(offset)) };
        let (halves, open) = solid.cut(&plane).expect("a cut");
        prop_assert!(!open);
        let mut sum = 0.0;
        for (half, side) in halves.iter().zip([-1.0, 1.0]) {
            if let Some(half) = half {
                sum += check(half)?;
                prop_assert!(half.mesh().points.iter().all(|at| plane.distance(*at) * side > -2e-6));
            }
        }
        prop_assert!((sum - solid.volume()).abs() < 1e-4 * solid.volume(), "{sum} {}", solid.volume());
    }

    #[test]
    fn the_parts_of_a_split_become_the_whole_again(solid in solids(), axis in 0..3usize, size in 0.7..3.0f64) {
        let sizes = PartSizes(vec![
            SizedParts::One(PartSize::Absolute(0.5)),
            SizedParts::Repeated(vec![PartSize::Flexible(size), PartSize::Absolute(0.2)]),
        ]);
        let axis = [SplitAxis::X, SplitAxis::Y, SplitAxis::Z][axis];
        let split = solid.split(axis, &sizes).expect("a split");
        prop_assert!(!split.open);
        let mut sum = 0.0;
        for (_, part) in &split.parts {
            sum += check(part)?;
        }
        if split.rest == 0.0 {
            prop_assert!((sum - solid.volume()).abs() < 1e-4 * solid.volume(), "{sum} {}", solid.volume());
        }
        let parts: Vec<&Shape> = split.parts.iter().map(|(_, part)| part).collect();
        let whole = Shape::join(&parts).expect("joined").expect("parts").recompose().expect("recomposed");
        prop_assert!((whole.volume() - sum).abs() < 1e-4 * sum.max(1.0), "{} {sum}", whole.volume());
        check(&whole)?;
    }

    #[test]
    fn strips_and_rest_of_a_setback_fill_the_face(
        radii in proptest::collection::vec(0.0..6.0f64, 5..14), hole in any::<bool>(), distance in 0.05..2.5f64, still in 0..5usize,
    ) {
        let face = plan(&radii, hole, false);
        let setback = face.setback(|edge, _| if edge == still { 0.0 } else { distance }).expect("a setback");
        let area = |faces: &[Shape]| faces.iter().map(Shape::area).sum::<f64>();
        let sum = area(&setback.border) + area(&setback.inner);
        prop_assert!((sum - face.area()).abs() < 1e-4 * face.area(), "{sum} {}", face.area());
        for rest in &setback.inner {
            for at in &rest.mesh().points {
                prop_assert!((at.z - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_setback_to_an_area_leaves_that_area(
        radii in proptest::collection::vec(0.0..6.0f64, 5..14), hole in any::<bool>(), share in 0.05..0.95f64,
    ) {
        let face = plan(&radii, hole, false);
        let (setback, distance) = face.setback_to_area(face.area() * share).expect("an area");
        let rest: f64 = setback.inner.iter().map(Shape::area).sum();
        prop_assert!((rest / face.area() - share).abs() < 1e-4 && distance > 0.0, "{rest} {distance}");
    }

    #[test]
    fn set_operations_have_consistent_volumes(one in solids(), two in solids(), shift in (-4.0..4.0f64, -4.0..4.0f64, -2.0..2.0f64), lattice in any::<bool>()) {
        // On a lattice, faces and edges often coincide.
        let shift = DVec3::from(shift);
        let two = two.translate(if lattice { shift.round() } else { shift });
        let volume = |operation| -> Result<f64, TestCaseError> {
            match one.combine(&two, operation).map(|combined| combined.solid) {
                Ok(Some(solid)) => {
                    let mesh = solid.mesh();
                    for face in &mesh.faces {
                        let has = |tag: &str| face.style.iter().any(|style| style.tags.iter().any(|own| **own == *tag));
                        let source = if has("bool.a") { &one } else { &two };
                        prop_assert!(has("bool.a") != has("bool.b"));
                        let (center, area) = mesh.centroid(face);
                        // The normal of a sliver is uncertain.
                        prop_assert!(area < 1e-5 || lies_on(center, mesh.normal(face), source), "a face has the tag of another");
                    }
                    check(&solid)
                }
                Ok(None) => Ok(0.0),
                Err(error) => Err(TestCaseError::fail(error.to_string())),
            }
        };
        let (union, both, rest) =
            (volume(SolidOperation::Union)?, volume(SolidOperation::Intersection)?, volume(SolidOperation::Difference)?);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4 * (one.volume() + two.volume());
        prop_assert!(near(union + both, one.volume() + two.volume()), "{union} + {both}");
        prop_assert!(near(rest + both, one.volume()), "{rest} + {both} = {}", one.volume());
    }

    #[test]
    fn every_face_of_a_solid_is_selected_by_one_direction(solid in solids()) {
        let count: usize = ["top", "bottom", "side"]
            .map(|name| solid.faces(&Selector::read(name).expect("known")).expect("faces").len())
            .iter()
            .sum();
        prop_assert_eq!(count, solid.body.faces());
        let area: f64 = solid.faces(&Selector::All).expect("faces").iter().map(Shape::area).sum();
        prop_assert!((area - solid.area()).abs() < 1e-9 * area);
    }
}
