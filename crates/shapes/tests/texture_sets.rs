//! Named sets of texture coordinates after each operation.

use std::sync::Arc;

use burgeon_geometry::roof::{Eaves, Ends, Rise, RoofShape, RoofSurface};
use burgeon_shapes::{
    CutPlane, EdgeKind, EnvelopeLimit, HoleOutline, PartSize, PartSizes, Selector, Shape, SizedParts,
    SolidOperation, SplitAxis, SweepPath, UvMap,
};
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// A projection that no axis and no symmetry of the shapes hides.
fn map() -> UvMap {
    UvMap {
        origin: DVec3::new(0.3, 0.2, 0.1),
        u: DVec3::new(0.5, 0.1, 0.2),
        v: DVec3::new(0.1, 0.4, 0.3),
        offset: DVec2::new(0.7, 0.2),
    }
}

fn project_both(shape: Shape) -> Shape {
    let set: Arc<str> = "wall".into();
    shape.project(UvMap { offset: DVec2::ZERO, ..map() }).project_set(&set, map())
}

/// Returns the number of faces with the set and without, after checking that the set is where it was projected before the movement
/// `frame`, and that the first set has the same fate.
fn count(shape: &Shape, frame: &DAffine3) -> (usize, usize) {
    let mesh = shape.mesh();
    let (mut with, mut without) = (0, 0);
    for face in &mesh.faces {
        let style = face.style.as_deref();
        let set = style.and_then(|style| style.set("wall"));
        assert_eq!(set.is_some(), style.is_some_and(|style| style.uv.is_some()));
        let Some(set) = set else {
            without += 1;
            continue;
        };
        with += 1;
        for [from, _] in face.edges() {
            let at = mesh.at(from);
            let before = frame.inverse().transform_point3(at);
            let (found, expected) = (set.at(at), map().at(before));
            assert!(found.distance(expected) < 1e-6, "{found} at {at}, not {expected}");
        }
    }
    (with, without)
}

fn kept(shape: &Shape) -> (usize, usize) {
    count(shape, &DAffine3::IDENTITY)
}

/// Returns a part of this size, and the rest.
fn sizes(first: f64) -> PartSizes {
    PartSizes(vec![SizedParts::One(PartSize::Absolute(first)), SizedParts::One(PartSize::Flexible(1.0))])
}

fn block() -> Shape {
    project_both(Shape::cuboid(DVec3::new(4.0, 3.0, 2.0)))
}

fn face() -> Shape {
    project_both(Shape::rectangle(DVec2::new(4.0, 3.0)))
}

#[test]
fn cuts_trims_and_bevels_keep_the_sets_of_faces_and_new_faces_have_none() {
    let slant = CutPlane::through(DVec3::splat(1.0), DVec3::new(1.0, 1.0, 1.0).normalize());
    let ([below, above], _) = block().cut(&slant).expect("a cut");
    assert_eq!([below, above].map(|part| kept(&part.expect("a part"))), [(4, 1), (6, 1)]);
    let roof = Shape::rectangle(DVec2::new(4.0, 3.0)).taper(2.0, 0.0).expect("a pyramid");
    let side = roof.faces(&Selector::read("side").expect("a selector")).expect("sides").swap_remove(0);
    let (rest, _) = block().trim_by(&side.trim_planes()).expect("a rest");
    // A face on each of the three trim planes.
    assert_eq!(kept(&rest.expect("a rest")), (2, 3));
    let chamfered = block().bevel(0.2, 0, Some(&[EdgeKind::Corner])).expect("a solid");
    assert_eq!(kept(&chamfered.solid), (6, 4));
    let rounded = block().bevel(0.2, 3, Some(&[EdgeKind::Corner])).expect("a solid");
    assert_eq!(kept(&rounded.solid), (6, 12));
    let tool = Shape::cuboid(DVec3::ONE).translate(DVec3::new(3.5, 1.0, 0.5));
    let cut = block().combine(&tool, SolidOperation::Difference).expect("a cut").solid.expect("a rest");
    assert_eq!(kept(&cut), (6, 5));
    let parts = block().split(SplitAxis::X, &sizes(1.0)).expect("parts");
    let counts: Vec<_> = parts.parts.iter().map(|(_, part)| kept(part)).collect();
    assert_eq!(counts, [(5, 1), (5, 1)]);
}

#[test]
fn movements_move_the_sets() {
    let moved = |shape: Shape, frame: DAffine3| assert_eq!(count(&shape, &frame), (6, 0));
    let (offset, axis) = (DVec3::new(5.0, -2.0, 1.0), DVec3::new(0.6, 0.0, 0.8));
    moved(block().translate(offset), DAffine3::from_translation(offset));
    moved(block().rotate(DVec3::ZERO, axis, 0.7), DAffine3::from_axis_angle(axis, 0.7));
    moved(
        block().resize(DVec3::new(8.0, 3.0, 1.0)).expect("a size"),
        DAffine3::from_scale(DVec3::new(2.0, 1.0, 0.5)),
    );
    let mirror = DMat3::IDENTITY - DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z) * 2.0;
    moved(block().mirror(DVec3::ZERO, axis), DAffine3::from_mat3(mirror));
    let frame = DAffine3::from_mat3_translation(DMat3::from_rotation_x(0.4), offset);
    moved(block().transform(&frame), frame);
    moved(block().reverse(), DAffine3::IDENTITY);
    moved(block().align(DMat3::from_rotation_z(0.5)), DAffine3::IDENTITY);
}

#[test]
fn faces_that_operations_make_of_a_face_have_its_sets() {
    let side = |_: usize, _: &Shape| 0.4;
    let setback = face().setback(side).expect("strips");
    let parts = setback.border.iter().chain(&setback.inner);
    assert_eq!(parts.map(kept).collect::<Vec<_>>(), [(1, 0); 5]);
    assert_eq!(kept(&face().offset(0.5).expect("a face")[0]), (1, 0));
    assert_eq!(
        kept(&face().crop(DVec2::splat(0.5), DVec2::splat(2.0)).expect("a face").expect("a part")),
        (1, 0)
    );
    assert_eq!(kept(&face().inner_rectangle().expect("a face").expect("a part")), (1, 0));
    assert_eq!(kept(&face().rectify(0.1).expect("a face")), (1, 0));
    assert_eq!(kept(&face().ground_plan(0.0).expect("a face").expect("a part")), (1, 0));
    let square = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)].map(DVec2::from).to_vec();
    let holed = face().cut_hole(HoleOutline::Rings(&[square])).expect("a face").rest.expect("a rest");
    assert_eq!((kept(&holed), kept(&holed.without_holes())), ((1, 0), (1, 0)));
    let convex = holed.convexify().expect("convex faces");
    assert!(matches!(kept(&convex), (2..=9, 0)), "{:?}", kept(&convex));
    assert_eq!(kept(&face().extrude(2.0, None).expect("a solid")), (6, 0));
    assert_eq!(kept(&holed.extrude(2.0, None).expect("a solid")), (10, 0));
    assert_eq!(kept(&face().taper(2.0, 0.5).expect("a solid")), (6, 0));
    assert_eq!(kept(&face().taper(2.0, 0.0).expect("a solid")), (5, 0));
    assert_eq!(kept(&face().recess(0.3).expect("a recess")).1, 0);
    let hips = RoofShape {
        surface: RoofSurface::Sloped(Ends::Hips, &[]),
        rise: Rise::Height(2.0),
        overhang: 0.5,
        eaves: Eaves::Slab,
        slab: 0.2,
    };
    let profile = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1)].map(DVec2::from);
    assert_eq!(kept(&face().molding(&profile).expect("a molding").0), (12, 0));
    assert_eq!(kept(&face().roof(&hips, None).expect("a roof").shape).1, 0);
    let limit = EnvelopeLimit { height: 3.0, angle: 1.0 };
    // The slopes of an envelope are cuts.
    assert_eq!(kept(&face().envelope(6.0, |_| Some(limit)).expect("an envelope")).1, 4);
    let areas = face().split_area(SplitAxis::X, &sizes(4.0)).expect("parts");
    assert_eq!(areas.parts.iter().map(|(_, part)| kept(part)).collect::<Vec<_>>(), [(1, 0); 2]);
}

#[test]
fn reduced_joined_and_recomposed_solids_keep_the_sets() {
    let ball = project_both(Shape::sphere(2.0, 24).expect("a ball"));
    let (reduced, _) = ball.reduce(0.5).expect("fewer faces");
    let (with, without) = kept(&reduced);
    assert!(with > 50 && with < kept(&ball).0 && without == 0, "{with} {without}");
    let far = block().translate(DVec3::X * 9.0);
    let pair = Shape::join(&[&block(), &far]).expect("a pair").expect("a pair");
    for (piece, offset) in pair.pieces().expect("pieces").iter().zip([0.0, 9.0]) {
        assert_eq!(count(piece, &DAffine3::from_translation(DVec3::X * offset)), (6, 0));
    }
    let parts = block().split(SplitAxis::X, &sizes(1.0)).expect("parts");
    let parts: Vec<&Shape> = parts.parts.iter().map(|(_, part)| part).collect();
    let whole = Shape::join(&parts).expect("a whole").expect("a whole").recompose().expect("a whole");
    assert_eq!(kept(&whole), (6, 0));
    assert_eq!(kept(&block().join_faces(&Selector::All).expect("faces")), (6, 0));
}

#[test]
fn the_ends_of_a_sweep_have_the_sets_of_its_profile_and_the_sides_none() {
    let profile = project_both(Shape::rectangle(DVec2::new(0.4, 0.2)).translate(DVec3::new(-0.1, 0.0, 0.5)));
    let points = vec![DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.0, 3.0), DVec3::new(4.0, 2.0, 8.0)];
    let path = SweepPath { points, twist: 0.5, scale: 2.0, ..SweepPath::default() };
    let (solid, crossing) = profile.sweep(&path).expect("a sweep");
    assert!(crossing.is_empty() && solid.is_closed());
    let faces =
        |tag: &str| solid.faces(&Selector::read(&format!("tag:{tag}")).expect("a tag")).expect("faces");
    for (tag, corners) in [("sweep.start", 4), ("sweep.end", 4)] {
        let [end] = faces(tag).try_into().expect("one face");
        let mesh = end.mesh();
        let style = end.styles()[0].clone().expect("a style");
        let set = style.set("wall").expect("a set");
        let original = profile.mesh();
        let uvs = |mesh: &burgeon_shapes::PolygonMesh, map: &UvMap| -> Vec<[i64; 2]> {
            let mut all: Vec<[i64; 2]> = mesh
                .points
                .iter()
                .map(|at| map.at(*at).to_array().map(|number| (number * 1e6).round() as i64))
                .collect();
            all.sort_unstable();
            all
        };
        let expected = uvs(&original, &map());
        assert_eq!((uvs(&mesh, set), mesh.points.len()), (expected, corners), "{tag}");
    }
    assert!(!faces("sweep.side").is_empty());
    for side in faces("sweep.side") {
        assert!(side.styles().iter().flatten().all(|style| !style.is_projected()));
    }
}

#[test]
fn a_loft_has_the_sets_of_both_faces_at_its_ends() {
    let other: Arc<str> = "other".into();
    let high = Shape::rectangle(DVec2::new(2.0, 2.0)).translate(DVec3::Z * 3.0);
    let solid = face().loft(&high.project_set(&other, map())).expect("a loft");
    let mut names: Vec<(bool, bool)> = Vec::new();
    for face in &solid.mesh().faces {
        let style = face.style.as_deref().expect("a style");
        names.push((style.set("wall").is_some(), style.set("other").is_some()));
    }
    names.sort_unstable();
    assert_eq!(names, [[(false, true)].as_slice(), &[(true, false); 5]].concat());
    assert_eq!(kept(&face().loft(&high).expect("a loft")), (6, 0));
}
