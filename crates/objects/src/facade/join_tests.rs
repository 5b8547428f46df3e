//! Tests of joined faces: surfaces are few, close the frontage except for its border, and cover the same area as the
//! faces.

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::tests::{list, make, panel, sizes, table, text, wall};
use super::*;
use burgeon_geometry::solid;
use burgeon_kit::Value;
use burgeon_scene::{Material, Part};

/// Materials of walls; the first is the template's.
const COLORS: [&str; 3] = ["", "#aa4444", "#4444aa"];

fn made_of(color: usize) -> Option<(&'static str, Value)> {
    let material = || Value::Table(table(&[("color", text(COLORS[color]))]).into());
    (color > 0).then(|| ("material", material()))
}

fn number(number: f64) -> Value {
    Value::Number(number)
}

/// Returns the surfaces of `wall` over a frontage of this size (m), with one part for each material.
fn joined(wall: &Wall, size: DVec2) -> (Vec<Part>, Vec<(Material, f64)>) {
    let mut laid = FacadeLayout::default();
    assert!(laid.lay(wall, Rectangle { at: DVec2::ZERO, size }, 0.0), "{size}");
    let mut materials = Vec::<(Material, f64)>::new();
    let parts_of: Vec<usize> = laid
        .faces
        .iter()
        .map(|face| {
            let material = face.material.cloned().unwrap_or_default();
            let known = materials.iter().position(|known| known.0 == material);
            let part = known.unwrap_or_else(|| {
                materials.push((material, 0.0));
                materials.len() - 1
            });
            materials[part].1 += face.right.length() * face.up.length();
            part
        })
        .collect();
    let mut parts = vec![Part::default(); materials.len()];
    Joiner::default().join(&laid.faces, &parts_of, |number, mesh| {
        let (face, part) = (&laid.faces[number], &mut parts[parts_of[number]]);
        let base = part.positions.len() as u32;
        part.positions.extend(mesh.corners.iter().map(DVec3::as_vec3));
        let outside = face.right.cross(face.up);
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|corner| mesh.corners[corner as usize]);
            assert!((b - a).cross(c - a).dot(outside) > 0.0, "a triangle looks where its face does");
            part.triangles.push(triangle.map(|corner| base + corner));
        }
    });
    (parts, materials)
}

/// Returns a row of `count` recessed windows of 1 m by 1.5 m, in bays of 2 m by 3 m.
fn windows(count: u32) -> (Wall, DVec2) {
    let glass = panel(&[1.0, 1.0], &[1.5, 1.5]);
    let niche = make(extruded::kind(), &[("wall", glass), ("depth", number(-0.2))]).expect("a niche");
    let margins = ["left", "right", "bottom", "top"].map(|side| (side, number(0.5)));
    let bay = make(bordered::kind(), &[&[("wall", niche)], margins.as_slice()].concat()).expect("a bay");
    let row = make(grid::kind(), &[("wall", bay), ("columns", number(f64::from(count)))]).expect("a row");
    (wall(&row), DVec2::new(2.0 * f64::from(count), 3.0))
}

#[test]
fn a_wall_of_windows_is_one_surface_with_few_corners_and_triangles() {
    for count in [1, 3, 12] {
        let (wall, size) = windows(count);
        let (parts, _) = joined(&wall, size);
        let [part] = parts.as_slice() else { panic!("one material") };
        // The counts are the wall, and four sides and the glass of each window.
        let (triangles, corners) = (6 * count + 2 + count * 10, 4 * count + 4 + count * 20);
        assert_eq!((part.triangles.len(), part.positions.len()), (triangles as usize, corners as usize));
        let front = part.positions.iter().filter(|at| at.z == 0.0 && [0.0, 3.0].contains(&at.y));
        assert_eq!(front.count(), 4, "nothing between the corners of the frontage meets its border");
    }
}

#[test]
fn an_image_that_covers_a_face_once_is_not_joined() {
    let photo =
        Value::Table(table(&[("texture", text("a.png")), ("texture_size", sizes(&[1.0, 1.0]))]).into());
    let shown =
        make(panel::kind(), &[("decoration", photo), ("width", sizes(&[2.0, 2.0]))]).expect("a panel");
    let row = make(grid::kind(), &[("wall", shown), ("rows", number(1.0))]).expect("a row");
    let (parts, _) = joined(&wall(&row), DVec2::new(8.0, 3.0));
    assert_eq!((parts[0].triangles.len(), parts[0].positions.len()), (8, 16));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn surfaces_close_a_frontage_but_for_its_border_and_have_the_areas_of_the_faces(
        cell in (0.5..2.0f64, 0.0..2.0f64, 0.5..2.0f64, 0.0..2.0f64),
        margins in prop::array::uniform4(prop_oneof![Just(0.0), 0.01..1.0f64]),
        depths in prop::array::uniform4(prop::sample::select(vec![-0.4, -0.2, 0.0, 0.1, 0.3])),
        colors in prop::array::uniform6(0..COLORS.len()),
        (door, base) in (0.8..2.0f64, 2.0..4.0f64),
        (across, above) in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let with = |fields: &[(&'static str, Value)], color: usize| {
            [fields, made_of(color).as_slice()].concat()
        };
        let paint = |width: &[f64], height: &[f64], color: usize| {
            make(panel::kind(), &with(&[("width", sizes(width)), ("height", sizes(height))], color)).expect("a panel")
        };
        let stand = |wall: Value, depth: f64, color: usize| match depth {
            0.0 => wall,
            _ => make(extruded::kind(), &with(&[("wall", wall), ("depth", number(depth))], color)).expect("a wall"),
        };
        let window = paint(&[cell.0, cell.0 + cell.1], &[cell.2, cell.2 + cell.3], colors[0]);
        let window = stand(window, depths[0], colors[1]);
        let [left, right, bottom, top] = margins.map(number);
        let around = [("wall", window), ("left", left), ("right", right), ("bottom", bottom), ("top", top)];
        let framed = make(bordered::kind(), &with(&around, colors[2])).expect("a wall");
        let floors = make(grid::kind(), &[("wall", stand(framed, depths[1], colors[3]))]).expect("a grid");
        let entry = make(list::kind(), &[("walls", list(&[
            paint(&[0.0, 9.0], &[base, base], colors[4]),
            stand(paint(&[door, door], &[base, base], colors[5]), depths[2], colors[0]),
            stand(paint(&[0.1, 30.0], &[base, base], colors[2]), depths[3], colors[1]),
        ]))]).expect("a list");
        let walls = [entry, floors, paint(&[0.0, 99.0], &[0.3, 0.3], colors[3])];
        let whole = make(list::kind(), &[("walls", list(&walls)), ("direction", text("vertical"))]).expect("a list");
        let whole = wall(&whole);
        let size: [f64; 2] = [(0, across), (1, above)].map(|(side, at): (usize, f64)| {
            let sizes = &whole.0.sizes[side];
            sizes.nearest(sizes.low() + at * (sizes.high().min(30.0) - sizes.low()))
        });
        prop_assume!(whole.fits(size[0], size[1]));
        let (parts, materials) = joined(&whole, size.into());
        for (part, (_, area)) in parts.iter().zip(&materials) {
            let found = solid::area([part]);
            prop_assert!((found - area).abs() < 1e-4 * area.max(1.0), "{found} m², not {area} m²");
        }
        let check = solid::check(&parts);
        prop_assert_eq!(check.zero_area, 0);
        let [width, height] = size.map(|length| length as f32);
        for [a, b] in check.open.iter().chain(&check.inconsistent) {
            let both = |a: f32, b: f32, at: f32| (a - at).abs() < 1e-5 && (b - at).abs() < 1e-5;
            let on_border = both(a.x, b.x, 0.0) || both(a.x, b.x, width) || both(a.y, b.y, 0.0) || both(a.y, b.y, height);
            prop_assert!(on_border, "the side {a} to {b} has a triangle on one side only");
        }
    }
}
