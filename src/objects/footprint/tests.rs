//! Tests of footprints: every building is a closed solid with the volume that its roof encloses.

use super::*;
use crate::geometry::solid;

fn plan(rings: &[&[(f64, f64)]]) -> Rings {
    Rings(rings.iter().map(|ring| ring.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()).collect())
}

fn table(entries: &[(&str, Value)]) -> Option<Arc<Table>> {
    let entries =
        entries.iter().map(|(name, value)| (super::super::Key::Name((*name).into()), value.clone()));
    Some(Arc::new(Table { class: None, entries: entries.collect() }))
}

/// The volume (m³) of a building with walls of 3 m and this roof, after having checked that it is a solid.
fn volume(geometry: Rings, roof: &[(&str, Value)]) -> f64 {
    let mut house = Footprint::new(Options { geometry, ..Options::default() }).expect("a clean footprint");
    house.begin();
    house.groundwork("extruded".into(), None).expect("groundwork");
    house.walls(table(&[("height", Value::Number(3.0))])).expect("walls");
    house.roof(table(roof)).expect("a roof");
    let check = solid::check(house.drawing.parts());
    assert!(
        check.is_solid(),
        "{:?}: {check:?}",
        roof.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>()
    );
    assert!(house.notes.iter().all(|note| note.what.contains("overhang")), "{:?}", house.notes);
    solid::volume(house.drawing.parts())
}

fn kind(kind: &str) -> Vec<(&'static str, Value)> {
    vec![("kind", Value::Text(kind.into())), ("height", Value::Number(2.0))]
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-5 * expected, "{found} m³, expected {expected} m³");
}

#[test]
fn roofs_over_a_rectangle_have_the_volumes_of_the_textbook() {
    let rectangle = || plan(&[&[(0., 0.), (10., 0.), (10., 6.), (0., 6.)]]);
    let walls = 10.0 * 6.0 * 3.0;
    near(volume(rectangle(), &kind("flat")), walls);
    near(volume(rectangle(), &kind("shed")), walls + 60.0);
    near(volume(rectangle(), &kind("gable")), walls + 60.0);
    // A prism between the ends, and a pyramid of both ends together.
    near(volume(rectangle(), &kind("hip")), walls + 4.0 * 6.0 * 2.0 / 2.0 + 36.0 * 2.0 / 3.0);
    let border = [
        ("kind", Value::Text("flat".into())),
        ("border", Value::Number(1.0)),
        ("border_width", Value::Number(0.5)),
    ];
    near(volume(rectangle(), &border), walls + 60.0 - 9.0 * 5.0);
}

#[test]
fn every_roof_closes_every_plan() {
    let plans: [(&str, Rings); 7] = [
        ("square", plan(&[&[(0., 0.), (8., 0.), (8., 8.), (0., 8.)]])),
        ("rectangle", plan(&[&[(0., 0.), (12., 0.), (12., 7.), (0., 7.)]])),
        ("L", plan(&[&[(0., 0.), (12., 0.), (12., 5.), (5., 5.), (5., 12.), (0., 12.)]])),
        ("T", plan(&[&[(0., 0.), (12., 0.), (12., 4.), (8., 4.), (8., 11.), (4., 11.), (4., 4.), (0., 4.)]])),
        (
            "cross",
            plan(&[&[
                (4., 0.),
                (8., 0.),
                (8., 4.),
                (12., 4.),
                (12., 8.),
                (8., 8.),
                (8., 12.),
                (4., 12.),
                (4., 8.),
                (0., 8.),
                (0., 4.),
                (4., 4.),
            ]]),
        ),
        (
            "courtyard",
            plan(&[
                &[(0., 0.), (20., 0.), (20., 16.), (0., 16.)],
                &[(6., 6.), (6., 10.), (14., 10.), (14., 6.)],
            ]),
        ),
        (
            "irregular",
            plan(&[&[(0., 0.), (14., -2.), (19., 5.), (13., 8.), (14., 15.), (3., 13.), (5., 6.)]]),
        ),
    ];
    let mut count = 0;
    for (name, geometry) in plans {
        for roof in [
            "flat",
            "shed",
            "gable",
            "gambrel",
            "shed_gambrel",
            "hip",
            "mansard",
            "pagoda",
            "porch",
            "dutch_hip",
        ] {
            for (overhang, slab, eaves) in [
                (0.0, 0.0, "closed"),
                (0.6, 0.0, "closed"),
                (0.0, 0.25, "slab"),
                (0.6, 0.25, "slab"),
                (0.0, 0.0, "open"),
                (0.6, 0.25, "open"),
            ] {
                let mut options = kind(roof);
                options.push(("eaves", Value::Text(eaves.into())));
                options.push(("overhang", Value::Number(overhang)));
                options.push(("slab", Value::Number(slab)));
                options.push(("border", Value::Number(0.5)));
                assert!(volume(geometry.clone(), &options) > 0.0, "{name} {roof}");
                count += 1;
            }
        }
    }
    assert_eq!(count, 7 * 10 * 6);
}
