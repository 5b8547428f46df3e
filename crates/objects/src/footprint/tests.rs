//! Tests of footprints: every building is a closed solid with the volume that its roof encloses.

use super::options::FootprintOptions;
use super::*;
use burgeon_base::error::Result;
use burgeon_geometry::Rings;
use burgeon_geometry::solid;
use burgeon_kit::LevelOfDetail;
use burgeon_kit::Parameter;
use burgeon_kit::Show;
use burgeon_kit::{Kind, Object, Table, TableOf, Value};
use burgeon_scene::Part;
use burgeon_spatial::PolygonArgument;
use glam::{DVec2, DVec3};
use std::sync::Arc;

fn plan(rings: &[&[(f64, f64)]]) -> Rings {
    Rings(rings.iter().map(|ring| ring.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()).collect())
}

fn table(entries: &[(&str, Value)]) -> Arc<Table> {
    let entries =
        entries.iter().map(|(name, value)| (burgeon_kit::TableKey::Name((*name).into()), value.clone()));
    Arc::new(Table { class: None, entries: entries.collect() })
}

/// Converts entries to the table argument of a method.
fn given<T>(entries: &[(&str, Value)]) -> Option<TableOf<T>> {
    Some(table(entries).into())
}

/// Returns the volume (m³) of a building with walls of 3 m and this roof, after checking that it is a solid.
fn volume(geometry: Rings, roof: &[(&str, Value)]) -> f64 {
    let mut house =
        Footprint::new(FootprintOptions { geometry: geometry.into(), ..FootprintOptions::default() })
            .expect("a clean footprint");
    house.begin();
    house.groundwork("extruded".into(), None).expect("groundwork");
    house.walls(given(&[("height", Value::Number(3.0))])).expect("walls");
    house.roof(given(roof)).expect("a roof");
    let check = solid::check(house.drawing.parts());
    assert!(
        check.is_solid(),
        "{:?}: {check:?}",
        roof.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>()
    );
    assert!(house.notes.iter().all(|note| note.message().contains("overhang")), "{:?}", house.notes);
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
    // The volume is a prism between the ends, and a pyramid formed by both ends together.
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

/// Returns a house with a facade of recessed windows, at this level of detail.
fn with_facades(detail: u8) -> Footprint {
    use crate::facade;
    let object = |made: Result<Box<dyn Object>>| Value::Object(Arc::from(made.expect("a wall")));
    let make = |kind: &Kind, entries: &[(&str, Value)]| object(kind.make(&table(entries)));
    let size = |low: f64, high: f64| vec![low, high].into_value();
    let glass = make(facade::panel::kind(), &[("width", size(1.0, 1.0)), ("height", size(1.5, 1.5))]);
    let niche = make(facade::extruded::kind(), &[("wall", glass), ("depth", Value::Number(-0.2))]);
    let margins = ["left", "right", "bottom", "top"].map(|side| (side, Value::Number(0.5)));
    let window = make(facade::bordered::kind(), &[&[("wall", niche)], margins.as_slice()].concat());
    let template = make(facade::Template::kind(), &[("wall", window)]);
    let geometry = plan(&[&[(0., 0.), (12., 0.), (12., 5.), (5., 5.), (5., 12.), (0., 12.)]]);
    let keywords = super::EdgeKeywords([(2, vec!["blind".to_owned()])].into_iter().collect());
    let options = FootprintOptions {
        geometry: geometry.into(),
        edge_keywords: keywords,
        ..FootprintOptions::default()
    };
    let mut house = Footprint::new(options).expect("a clean footprint");
    house.set_detail(detail);
    house.begin();
    house.groundwork("z_min".into(), None).expect("groundwork");
    for _ in 0..2 {
        let walls = [("height", Value::Number(3.0)), ("templates", template.clone())];
        house.walls(given(&walls)).expect("walls");
    }
    house.roof(given(&kind("hip"))).expect("a roof");
    house.end().expect("an end");
    house
}

#[test]
fn each_level_of_detail_shows_less_and_all_but_facades_are_closed() {
    let count = |detail: u8| with_facades(detail).triangles();
    // The counts are the floor; a block of 6 walls and a lid; the same under a hip roof.
    assert_eq!((count(0), count(1)), (4, 4 + 12 + 4));
    assert!(count(1) < count(2) && count(2) < count(3));
    for (detail, volume) in [(1, 95.0 * 6.0), (2, 95.0 * 6.0)] {
        let house = with_facades(detail);
        assert!(solid::check(house.drawing.parts()).is_solid(), "{detail}");
        assert!(solid::volume(house.drawing.parts()) >= volume - 1e-3, "{detail}");
    }
}

#[test]
fn storeys_of_one_material_are_one_wall_where_detail_is_off() {
    // The house has 6 walls of two triangles and 4 triangles for the floor; the rest is roof, above 6 m.
    let house = with_facades(2);
    let upright = house.drawing.parts().iter().flat_map(|part| {
        part.triangles.iter().filter(|corners| {
            let [a, b, c] = corners.map(|corner| part.positions[corner as usize].z);
            a.max(b).max(c) < 6.001 && a.min(b).min(c) < 0.001 && (a - b).abs().max((b - c).abs()) > 5.0
        })
    });
    assert_eq!(upright.count(), 12);
}

#[test]
fn facades_cover_their_walls_and_leave_party_walls_plain() {
    let house = with_facades(3);
    assert!(house.notes.is_empty(), "{:?}", house.notes);
    let (mut front, mut back) = (0.0, 0.0);
    for part in house.drawing.parts() {
        for corners in &part.triangles {
            let [a, b, c] = corners.map(|corner| part.positions[corner as usize].as_dvec3());
            let area = (b - a).cross(c - a) / 2.0;
            // Walls on the south side face -y; walls recessed by 0.2 m are glass.
            if area.y < -1e-9 && area.z.abs() < 1e-9 && a.z.min(b.z).min(c.z) < 6.0 {
                let south = house.plan.flat()[0][0].y;
                let depth = [a.y, b.y, c.y].map(|y| ((y - south) * 1000.0).round());
                match depth {
                    [0.0, 0.0, 0.0] => front += area.length(),
                    [200.0, 200.0, 200.0] => back += area.length(),
                    _ => {}
                }
            }
        }
    }
    near(front, 2.0 * (12.0 * 3.0 - 1.5));
    near(back, 2.0 * 1.5);
    // The blind wall in the east consists of two rectangles, one for each storey.
    let east = house.plan.flat()[0][1].x as f32;
    let plain = house.drawing.parts().iter().flat_map(|part| {
        part.triangles.iter().filter(|corners| {
            corners.iter().all(|corner| {
                let at = part.positions[*corner as usize];
                at.x == east && at.z <= 6.0
            })
        })
    });
    assert_eq!(plain.count(), 4);
}

#[test]
fn textures_run_on_in_metres_over_the_joined_faces_of_a_facade() {
    let house = with_facades(3);
    let corner = house.plan.flat()[0][0];
    let mut count = 0;
    for part in house.drawing.parts() {
        for corners in &part.triangles {
            let on_south = |vertex: &u32| {
                let at = part.positions[*vertex as usize].as_dvec3();
                (at.y - corner.y).abs() < 1e-6 && (-1e-6..=6.0).contains(&at.z)
            };
            let normal = part.normals[corners[0] as usize].vector();
            if normal.y > -0.99 || !corners.iter().all(on_south) {
                continue;
            }
            for vertex in corners.map(|vertex| vertex as usize) {
                let (at, uv) = (part.positions[vertex].as_dvec3(), part.uvs[vertex].as_dvec2());
                assert!(uv.distance(DVec2::new(at.x - corner.x, at.z)) < 1e-5, "{at} has {uv}");
                count += 1;
            }
        }
    }
    // Each of the two storeys has windows with their walls.
    assert_eq!(count, 2 * 3 * (6 + 2));
}

#[test]
fn a_photo_covers_each_frontage_once() {
    let photo =
        table(&[("texture", Value::Text("front.png".into())), ("texture_size", vec![2.0, 4.0].into_value())]);
    let geometry = plan(&[&[(0., 0.), (12., 0.), (12., 5.), (0., 5.)]]);
    let mut house =
        Footprint::new(FootprintOptions { geometry: geometry.into(), ..FootprintOptions::default() })
            .expect("a clean footprint");
    house.begin();
    let photo = Value::Table(photo);
    house.walls(given(&[("height", Value::Number(6.0)), ("photo", photo)])).expect("walls");
    let textured = |part: &&Part| house.drawing.material_of(part.material).texture.is_some();
    let part = house.drawing.parts().iter().find(textured).expect("walls with the photo");
    assert_eq!((part.positions.len(), part.triangles.len()), (16, 8));
    for corners in part.uvs.chunks(4) {
        // The coordinates cover the whole image, 2 m wide and 4 m high, from its lower left corner.
        let uvs: Vec<[f32; 2]> = corners.iter().map(|uv| uv.to_array()).collect();
        assert_eq!(uvs, [[0.0, 0.0], [2.0, 0.0], [2.0, 4.0], [0.0, 4.0]]);
    }
}

#[test]
fn a_photo_with_bays_shows_whole_ones_on_each_frontage() {
    let photo = table(&[
        ("texture", Value::Text("front.png".into())),
        ("texture_size", vec![10.0, 12.0].into_value()),
    ]);
    let geometry = plan(&[&[(0., 0.), (12., 0.), (12., 0.6), (0., 0.6)]]);
    let mut house =
        Footprint::new(FootprintOptions { geometry: geometry.into(), ..FootprintOptions::default() })
            .expect("a clean footprint");
    house.begin();
    let walls = |bay: Vec<f64>, photo: Option<Value>| {
        let bay = ("bay", bay.into_value());
        let all = [Some(("height", Value::Number(7.0))), Some(bay), photo.map(|photo| ("photo", photo))];
        given(&all.into_iter().flatten().collect::<Vec<_>>())
    };
    house.walls(walls(vec![2.5, 3.0], Some(Value::Table(photo)))).expect("walls");
    let textured = |part: &&Part| house.drawing.material_of(part.material).texture.is_some();
    let part = house.drawing.parts().iter().find(textured).expect("walls with the photo");
    let mut sizes = Vec::new();
    for corners in part.uvs.chunks(4) {
        let (first, size) = (corners[0], corners[2] - corners[0]);
        assert!((first.x / 2.5).fract() == 0.0 && first.x < 10.0 && first.y == 0.0, "{first}");
        sizes.push(size.to_array());
    }
    // 12 m is closest to five bays, 0.6 m still shows one bay, and 7 m is two storeys.
    assert_eq!(sizes, [[12.5, 6.0], [2.5, 6.0], [12.5, 6.0], [2.5, 6.0]]);
    for (bay, photo) in [(vec![2.5, 3.0], None), (vec![2.5], Some(())), (vec![0.0, 3.0], Some(()))] {
        let photo = photo.map(|()| Value::Table(table(&[("texture", Value::Text("front.png".into()))])));
        assert!(house.walls(walls(bay, photo)).is_err());
    }
}

#[test]
fn a_ring_with_a_bad_point_is_refused_by_the_number_of_the_point() {
    let point = |x: f64, y: f64| vec![x, y].into_value();
    let ring = vec![point(0.0, 0.0), point(4.0, 0.0), point(4.0, f64::NAN)];
    for (value, item) in [
        (ring.clone().into_value(), "must be a list whose item 3 is a vector"),
        (
            vec![ring.into_value()].into_value(),
            "must be a list whose item 1 is a list whose item 3 is a vector",
        ),
    ] {
        let refused = PolygonArgument::from_value(value.clone()).expect_err("no number");
        let error = refused.refuse("footprint", "geometry", &value).to_string();
        assert!(error.contains(item), "{error}");
    }
}
