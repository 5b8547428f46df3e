//! Tests of facades: walls fill their frontage exactly.

use std::sync::Arc;

use glam::DVec2;
use proptest::prelude::*;

use super::*;
use burgeon_kit::{Kind, Table, TableKey, Value};

pub(super) fn table(fields: &[(&str, Value)]) -> Table {
    let entries = fields.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    Table { class: None, entries: entries.collect() }
}

pub(super) fn list(values: &[Value]) -> Value {
    let entries = (1..).map(TableKey::Index).zip(values.iter().cloned()).collect();
    Value::Table(Arc::new(Table { class: None, entries }))
}

pub(super) fn sizes(values: &[f64]) -> Value {
    list(&values.iter().map(|value| Value::Number(*value)).collect::<Vec<_>>())
}

pub(super) fn text(text: &str) -> Value {
    Value::Text(text.into())
}

/// Creates a wall by the rule of `kind`, or returns the error message.
pub(super) fn make(kind: &Kind, fields: &[(&str, Value)]) -> Result<Value, String> {
    match kind.make(&table(fields)) {
        Ok(wall) => Ok(Value::Object(Arc::from(wall))),
        Err(error) => Err(error.message().to_owned()),
    }
}

/// Returns the error message for a wall that the rule of `kind` refuses.
fn refused(kind: &Kind, fields: &[(&str, Value)]) -> String {
    make(kind, fields).err().unwrap_or_default()
}

pub(super) fn wall(value: &Value) -> Wall {
    let Value::Object(object) = value else { panic!("a wall") };
    let any: &dyn std::any::Any = &**object;
    any.downcast_ref::<Wall>().expect("a wall").clone()
}

pub(super) fn panel(width: &[f64], height: &[f64]) -> Value {
    make(panel::kind(), &[("width", sizes(width)), ("height", sizes(height))]).expect("a panel")
}

/// Returns the faces of `wall` over a frontage, as left, bottom, right, top and depth (m).
fn laid(value: &Value, width: f64, height: f64) -> Vec<[f64; 5]> {
    let wall = wall(value);
    let mut laid = FacadeLayout::default();
    let over = Rectangle { at: DVec2::ZERO, size: DVec2::new(width, height) };
    assert!(laid.lay(&wall, over, 0.0), "{width} m x {height} m");
    let fronts = laid.faces.iter().filter(|face| face.right.z == 0.0 && face.up.z == 0.0);
    fronts
        .map(|face| [face.at.x, face.at.y, face.at.x + face.right.x, face.at.y + face.up.y, face.at.z])
        .collect()
}

fn assert_near(found: &[[f64; 5]], expected: &[[f64; 5]]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let apart = found.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-9, "{found:?}, expected {expected:?}");
}

#[test]
fn margins_keep_their_policies() {
    let center = panel(&[1.0, 1.4, 2.0], &[1.0, 2.0]);
    let margin = |size: f64, policy: &str| list(&[Value::Number(size), text(policy)]);
    let framed = make(
        bordered::kind(),
        &[
            ("wall", center),
            ("left", margin(0.5, "fixed")),
            ("right", Value::Number(0.2)),
            ("bottom", margin(0.6, "max")),
        ],
    )
    .expect("a wall");
    // The fixed margin stays, the minimum margin takes the remainder of the preferred width, and the maximum margin
    // gives way.
    assert_near(
        &laid(&framed, 3.0, 1.3),
        &[
            [0.0, 0.0, 0.5, 1.3, 0.0],
            [0.5, 0.0, 1.9, 0.3, 0.0],
            [1.9, 0.0, 3.0, 1.3, 0.0],
            [0.5, 0.3, 1.9, 1.3, 0.0],
        ],
    );
    assert!(!wall(&framed).fits(1.6, 2.0), "narrower than its parts");
    assert!(!wall(&framed).fits(3.0, 2.7), "higher than its parts");
}

#[test]
fn a_grid_has_the_number_of_cells_whose_size_is_nearest_to_the_preferred_one() {
    let row =
        make(grid::kind(), &[("wall", panel(&[2.0, 2.6, 4.0], &[3.0, 3.0])), ("rows", sizes(&[1.0, 5.0]))])
            .expect("a grid");
    for (width, height, cells) in [(10.0, 3.0, 4), (8.0, 6.0, 6), (3.9, 9.0, 3)] {
        assert_eq!(laid(&row, width, height).len(), cells, "{width} m x {height} m");
    }
    assert!(!wall(&row).fits(10.0, 4.0), "storeys of 3 m cannot be 4 m high together");
    assert!(!wall(&row).fits(10.0, 18.0), "six rows where five are allowed");
}

#[test]
fn lists_run_from_left_to_right_and_from_the_bottom_up() {
    let (base, top) = (panel(&[0.0, 99.0], &[3.5, 3.5]), panel(&[0.0, 99.0], &[0.0, 99.0]));
    let column =
        make(list::kind(), &[("walls", list(&[base.clone(), top])), ("direction", text("vertical"))]);
    let column = column.expect("a list");
    assert_near(&laid(&column, 4.0, 9.0), &[[0.0, 0.0, 4.0, 3.5, 0.0], [0.0, 3.5, 4.0, 9.0, 0.0]]);
    let door = panel(&[1.2, 1.2], &[3.5, 3.5]);
    let row = make(list::kind(), &[("walls", list(&[base, door]))]).expect("a list");
    assert_near(&laid(&row, 4.0, 3.5), &[[0.0, 0.0, 2.8, 3.5, 0.0], [2.8, 0.0, 4.0, 3.5, 0.0]]);
}

#[test]
fn what_is_extruded_has_the_sides_that_are_wanted_and_they_look_outwards() {
    for (depth, inwards) in [(0.4, -1.0), (-0.4, 1.0)] {
        let niche = make(
            extruded::kind(),
            &[
                ("wall", panel(&[0.0, 9.0], &[0.0, 9.0])),
                ("depth", Value::Number(depth)),
                ("top", Value::Boolean(false)),
            ],
        )
        .expect("a wall");
        let wall = wall(&niche);
        let mut laid = FacadeLayout::default();
        laid.lay(&wall, Rectangle { at: DVec2::ZERO, size: DVec2::new(2.0, 1.0) }, 0.0);
        let middle = glam::DVec3::new(1.0, 0.5, depth / 2.0);
        assert_eq!(laid.faces.len(), 4, "three sides and the panel");
        for face in laid.faces.iter().filter(|face| face.right.cross(face.up).z == 0.0) {
            let normal = face.right.cross(face.up).normalize();
            let towards = middle - (face.at + (face.right + face.up) / 2.0);
            assert!(normal.dot(towards) * inwards > 0.0, "{face:?}");
        }
        assert_eq!(laid.faces[3].at.z, depth);
    }
}

#[test]
fn what_can_never_fit_is_refused_when_it_is_made() {
    let (low, high) = (panel(&[1.0, 2.0], &[1.0, 1.0]), panel(&[1.0, 2.0], &[2.0, 3.0]));
    let error = refused(list::kind(), &[("walls", list(&[low.clone(), high]))]);
    assert_eq!(error, "list: it can never fit: wall 2 is 2 to 3 m high, the walls before it are 1 m high");
    let error = refused(
        bordered::kind(),
        &[("wall", low), ("left", Value::Number(3.0)), ("width", sizes(&[1.0, 2.0]))],
    );
    assert_eq!(
        error,
        "bordered: it can never fit: its parts are at least 4 m wide, but it must be 1 to 2 m wide"
    );
    assert_eq!(refused(grid::kind(), &[]), "grid: missing wall to repeat");
}

fn template(keywords: &[&str], weight: f64, width: &[f64]) -> Value {
    let words: Vec<Value> = keywords.iter().map(|word| text(word)).collect();
    let wall = panel(width, &[0.0, 99.0]);
    let fields = [("wall", wall), ("keywords", list(&words)), ("weight", Value::Number(weight))];
    make(Template::kind(), &fields).expect("a template")
}

#[test]
fn the_template_that_shares_most_keywords_wins_and_ties_are_drawn_by_weight() {
    use burgeon_kit::Parameter;
    let any = &[0.0, 99.0];
    let all = [
        template(&[], 1.0, any),
        template(&[], 3.0, any),
        template(&["entry door"], 1.0, any),
        template(&["entry door", "shop"], 1.0, &[8.0, 99.0]),
        template(&["blind"], 1.0, any),
    ];
    let templates = Templates::from_value(list(&all)).expect("templates");
    let chosen = |keywords: &[&str], width: f64, chance: f64| {
        let found = templates.choose(keywords, width, 3.0, chance)?;
        all.iter().position(|one| {
            let Value::Object(object) = one else { return false };
            let any: &dyn std::any::Any = &**object;
            any.downcast_ref::<Template>()
                .is_some_and(|one| std::ptr::eq(one.wall().0.as_ref(), found.wall().0.as_ref()))
        })
    };
    assert_eq!(chosen(&["entry door", "shop"], 9.0, 0.5), Some(3));
    assert_eq!(chosen(&["entry door", "shop"], 5.0, 0.5), Some(2), "too narrow for the shop");
    assert_eq!(chosen(&["corner"], 5.0, 0.2), Some(0), "one in four");
    assert_eq!(chosen(&["corner"], 5.0, 0.3), Some(1));
    assert_eq!(chosen(&["blind", "entry door"], 9.0, 0.5), Some(4));
    assert_eq!(chosen(&["corner"], 100.0, 0.5), None);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_faces_of_a_wall_cover_its_frontage_once(
        cell in (0.5..2.0f64, 0.0..2.0f64, 0.5..2.0f64, 0.0..2.0f64),
        margins in (0.0..1.0f64, 0.0..1.0f64, 0usize..3, 0usize..3),
        (door, base) in (0.8..2.0f64, 2.0..4.0f64),
        (across, above) in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let policy = |size: f64, index: usize| list(&[Value::Number(size), text(["min", "max", "fixed"][index])]);
        let window = panel(&[cell.0, cell.0 + cell.1], &[cell.2, cell.2 + cell.3]);
        let framed = make(bordered::kind(), &[
            ("wall", window), ("left", policy(margins.0, margins.2)), ("top", policy(margins.1, margins.3)),
        ]).expect("a wall");
        let floors = make(grid::kind(), &[("wall", framed)]).expect("a grid");
        let entry = make(list::kind(), &[("walls", list(&[
            panel(&[0.0, 9.0], &[base, base]), panel(&[door, door], &[base, base]), panel(&[0.1, 30.0], &[base, base]),
        ]))]).expect("a list");
        let whole = make(list::kind(), &[("walls", list(&[entry, floors])), ("direction", text("vertical"))]).expect("a list");
        let [width, height] = [(0, across), (1, above)].map(|(side, at): (usize, f64)| {
            let sizes = &wall(&whole).0.sizes[side];
            sizes.nearest(sizes.low() + at * (sizes.high().min(40.0) - sizes.low()))
        });
        prop_assume!(wall(&whole).fits(width, height));
        let faces = laid(&whole, width, height);
        let area: f64 = faces.iter().map(|face| (face[2] - face[0]) * (face[3] - face[1])).sum();
        prop_assert!((area - width * height).abs() < 1e-9 * (width * height).max(1.0), "{area}, not {}", width * height);
        let bounds = faces.iter().all(|face| {
            face[0] > -1e-9 && face[1] > -1e-9 && face[2] < width + 1e-9 && face[3] < height + 1e-9
        });
        prop_assert!(bounds);
        for (index, a) in faces.iter().enumerate() {
            let apart = faces[..index].iter().all(|b| {
                a[0].max(b[0]) > a[2].min(b[2]) - 1e-9 || a[1].max(b[1]) > a[3].min(b[3]) - 1e-9
            });
            prop_assert!(apart, "two faces overlap");
        }
    }
}
