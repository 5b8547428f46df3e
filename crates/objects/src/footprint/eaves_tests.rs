//! Tests of roofs and their surroundings: projecting storeys, neighbours, and the materials of walls.

use super::options::FootprintOptions;
use super::*;
use crate::MaterialOptions;
use crate::facade;
use crate::roofs::Height;
use burgeon_base::random::Stream;
use burgeon_geometry::Rings;
use burgeon_kit::TableKey;
use burgeon_kit::{Color, Parameter};
use burgeon_kit::{Kind, Object, Table, Value};
use glam::{DVec2, DVec3};
use std::sync::Arc;

fn table(entries: &[(&str, Value)]) -> Table {
    let entries = entries.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    Table { class: None, entries: entries.collect() }
}

fn make(kind: &Kind, entries: &[(&str, Value)]) -> Value {
    Value::Object(Arc::from(kind.make(&table(entries)).expect("a wall")))
}

fn number(number: f64) -> Value {
    Value::Number(number)
}

fn text(text: &str) -> Value {
    Value::Text(text.into())
}

fn material(color: &str) -> Value {
    Value::Table(Arc::new(table(&[("color", text(color))])))
}

/// Returns a wall of this colour that projects by `depth` (m).
fn template(depth: f64, color: &str) -> Value {
    let wall = make(
        facade::extruded::kind(),
        &[("wall", make(facade::panel::kind(), &[])), ("depth", number(depth))],
    );
    make(facade::Template::kind(), &[("wall", wall), ("material", material(color))])
}

fn on(geometry: Rings, height: f64) -> Footprint {
    let height = (height > 0.0).then_some(Height(height));
    Footprint::new(FootprintOptions { geometry: geometry.into(), height, ..FootprintOptions::default() })
        .expect("a footprint")
}

fn rectangle(low: DVec2, size: DVec2, turn: DVec2) -> Rings {
    let corners = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(DVec2::from);
    Rings(vec![corners.map(|corner| turn.rotate(low + corner * size).extend(0.0)).to_vec()])
}

/// Returns a house of 10 m by 6 m with these walls, one above the other, and this roof.
fn house(walls: &[Table], roof: &[(&str, Value)]) -> Footprint {
    let mut house = on(rectangle(DVec2::ZERO, DVec2::new(10.0, 6.0), DVec2::X), 0.0);
    house.begin();
    for walls in walls {
        house.walls(Some(Arc::new(walls.clone()).into())).expect("walls");
    }
    house.roof(Some(Arc::new(table(roof)).into())).expect("a roof");
    house
}

fn points(house: &Footprint) -> impl Iterator<Item = DVec3> + '_ {
    house.drawing.parts().iter().flat_map(|part| &part.positions).map(|at| at.as_dvec3())
}

#[test]
fn a_roof_juts_out_beyond_the_outermost_storey_and_nothing_passes_through_it() {
    let storey = |depth: f64| table(&[("height", number(3.0)), ("templates", template(depth, "#a03020"))]);
    for kind in ["hip", "gable", "shed", "mansard", "dutch_hip"] {
        for eaves in ["closed", "slab", "open"] {
            // The outermost storey is not the topmost one.
            for depths in [[0.2, 0.5], [0.5, 0.2]] {
                let roof = [("kind", text(kind)), ("eaves", text(eaves)), ("overhang", number(0.4))];
                let house = house(&depths.map(storey), &roof);
                let middle = house.plan.flat()[0].iter().sum::<DVec2>() / 4.0;
                let out = |at: DVec3| ((at.truncate() - middle).abs() - DVec2::new(5.0, 3.0)).max_element();
                let furthest = points(&house).map(out).fold(0.0, f64::max);
                assert!((furthest - 0.9).abs() < 1e-5, "{kind} {eaves} {depths:?}: {furthest} m");
                // The plate slopes down from the projecting walls.
                let low = || points(&house).filter(|at| at.z < 6.0 - 1e-5 && out(*at) > 0.5 + 1e-5);
                assert!(low().all(|at| out(at) > 0.85), "{kind} {eaves} {depths:?}");
                assert_eq!(low().count() > 0, eaves == "open", "{kind} {eaves} {depths:?}");
            }
        }
    }
}

#[test]
fn a_gable_goes_on_as_the_wall_below_it_unless_it_is_given_a_material() {
    let grey = FootprintOptions::default().color;
    let red = [("height", number(3.0)), ("templates", template(0.0, "#a03020"))];
    let plain = [("height", number(3.0)), ("color", text("#a03020"))];
    let photo = [table(&[("texture", text("front.png"))])].map(|photo| Value::Table(Arc::new(photo)));
    let photo = [("height", number(3.0)), ("photo", photo[0].clone()), ("color", text("#a03020"))];
    let bare = [("height", number(3.0))];
    let color = |walls: &[(&str, Value)], more: &[(&str, Value)]| {
        let roof = [&[("kind", text("gable")), ("color", text("#204060"))], more].concat();
        let house = house(&[table(walls)], &roof);
        let mut found = None;
        for part in house.drawing.parts() {
            for corners in &part.triangles {
                let [a, b, c] = corners.map(|corner| part.positions[corner as usize].as_dvec3());
                let upright = (b - a).cross(c - a).normalize_or_zero().z.abs() < 1e-6;
                if upright && a.z.max(b.z).max(c.z) > 3.1 {
                    found = Some(house.drawing.material_of(part.material).base_color);
                }
            }
        }
        found.expect("a gable")
    };
    let expected =
        MaterialOptions::from_value(material("#a03020")).expect("a colour").material().expect("a material");
    for walls in [&red[..], &plain[..], &photo[..]] {
        assert_eq!(color(walls, &[]), expected.base_color);
    }
    assert_eq!(color(&bare, &[]), grey.0);
    let own =
        MaterialOptions::from_value(material("#102030")).expect("a colour").material().expect("a material");
    assert_eq!(color(&red, &[("gable", material("#102030"))]), own.base_color);
}

#[test]
fn walls_of_a_template_without_a_material_have_the_colour_of_the_building() {
    let own = Color::of_bytes([10, 20, 30, 255]);
    let bare = make(facade::Template::kind(), &[("wall", make(facade::panel::kind(), &[]))]);
    let colors = |walls: &[(&str, Value)], detail: u8| {
        let geometry = rectangle(DVec2::ZERO, DVec2::new(10.0, 6.0), DVec2::X).into();
        let options = FootprintOptions { geometry, color: own, ..FootprintOptions::default() };
        let mut house = Footprint::new(options).expect("a footprint");
        house.detail = detail;
        house.begin();
        house.walls(Some(Arc::new(table(walls)).into())).expect("walls");
        house.finish_walls().expect("walls");
        let drawn = house.drawing.parts().iter().filter(|part| !part.triangles.is_empty());
        drawn.map(|part| house.drawing.material_of(part.material).base_color).collect::<Vec<_>>()
    };
    let given =
        MaterialOptions::from_value(material("#a03020")).expect("a colour").material().expect("a material");
    for detail in [2, 3] {
        let walls = [("height", number(3.0)), ("templates", bare.clone())];
        let found = colors(&walls, detail);
        assert!(!found.is_empty() && found.iter().all(|color| *color == own.0), "{detail}: {found:?}");
        let red = [&walls[..], &[("color", text("#a03020"))]].concat();
        let found = colors(&red, detail);
        let is_known = |color: &[f32; 4]| *color == own.0 || *color == given.base_color;
        assert!(found.contains(&given.base_color) && found.iter().all(is_known), "{detail}: {found:?}");
    }
}

/// Returns a row of adjacent houses, each with its height (m).
fn row(random: &mut Stream) -> Vec<(Rings, f64)> {
    let turn = DVec2::from_angle(6.3 * random.uniform());
    let mut x = 0.0;
    let mut houses = Vec::new();
    for _ in 0..6 {
        let size = DVec2::new(5.0 + 6.0 * random.uniform(), 8.0 + 4.0 * random.uniform());
        let front = if random.below(2) == 0 { 0.0 } else { 3.0 * random.uniform() };
        houses.push((rectangle(DVec2::new(x, front), size, turn), 3.0 * (1 + random.below(4)) as f64));
        x += size.x + [0.0, 0.0, 0.1, 1.2 * random.uniform()][random.below(4)];
        if random.below(3) == 0 {
            // Some houses have another one behind them.
            let low = DVec2::new(x - size.x * 0.9, front + size.y + [0.0, 0.5][random.below(2)]);
            houses.push((rectangle(low, DVec2::new(4.0, 5.0), turn), 3.0 * (1 + random.below(4)) as f64));
        }
    }
    houses
}

#[test]
fn eaves_do_not_cut_into_neighbours_that_are_as_high_or_higher() {
    let mut random = Stream::new(7);
    let mut overhangs = [0, 0];
    for round in 0..120 {
        let all = row(&mut random);
        let mut objects: Vec<Box<dyn Object>> = all
            .iter()
            .map(|(rings, height)| Box::new(on(rings.clone(), *height)) as Box<dyn Object>)
            .collect();
        object::gather(&mut objects);
        let overhang = 0.6;
        for (own, object) in objects.iter_mut().enumerate() {
            let any: &mut dyn std::any::Any = &mut **object;
            let house = any.downcast_mut::<Footprint>().expect("a footprint");
            house.begin();
            house.walls(None).expect("walls");
            let (kind, eaves) =
                (["hip", "gable", "shed", "mansard"][round % 4], ["open", "closed"][round / 4 % 2]);
            let roof = [("kind", text(kind)), ("eaves", text(eaves)), ("overhang", number(overhang))];
            house.roof(Some(Arc::new(table(&roof)).into())).expect("a roof");
            let mut furthest = 0.0f64;
            for part in house.drawing.parts() {
                for corners in &part.triangles {
                    let corners =
                        corners.map(|corner| part.positions[corner as usize].as_dvec3() + house.origin());
                    for (side, step) in (0..3).flat_map(|side| (0..10).map(move |step| (side, step))) {
                        let at = corners[side].lerp(corners[(side + 1) % 3], f64::from(step) / 10.0);
                        furthest = furthest.max(-depth(&all[own].0[0], at.truncate()));
                        for (other, (rings, height)) in all.iter().enumerate() {
                            let cuts =
                                other != own && at.z < *height && depth(&rings[0], at.truncate()) > 0.011;
                            assert!(
                                !cuts,
                                "{round}: {kind} {eaves}: house {own} at {at} in house {other} of {all:?}"
                            );
                        }
                    }
                }
            }
            overhangs[usize::from(furthest > overhang * 0.99)] += 1;
        }
    }
    // Most houses have a free side.
    assert!(overhangs[1] > 9 * overhangs[0], "{overhangs:?}");
}

/// Returns the depth (m) of a position inside a convex ring, or a negative number outside.
fn depth(ring: &[DVec3], at: DVec2) -> f64 {
    burgeon_geometry::planar::edges(ring)
        .map(|[a, b]| (b - a).truncate().normalize_or_zero().perp_dot(at - a.truncate()))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn an_overhang_that_gives_way_tells_whether_a_neighbour_is_the_cause() {
    let ring =
        |corners: &[(f64, f64)]| Rings(vec![corners.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()]);
    let angle = ring(&[(0., 0.), (12., 0.), (12., 5.), (5., 5.), (5., 12.), (0., 12.)]);
    let recess = ring(&[(0., 0.), (5., 0.), (5., 2.), (5.4, 2.), (5.4, 0.), (12., 0.), (12., 8.), (0., 8.)]);
    // The neighbour touches one of the two walls of the inner corner, which are in the same plane.
    let beside = ring(&[(5.05, 7.), (12., 7.), (12., 12.), (5.05, 12.)]);
    let notes = |rings: &[&Rings]| {
        let objects = rings.iter().map(|rings| Box::new(on((*rings).clone(), 6.0)) as Box<dyn Object>);
        let mut objects: Vec<_> = objects.collect();
        object::gather(&mut objects);
        let any: &mut dyn std::any::Any = &mut *objects[0];
        let house = any.downcast_mut::<Footprint>().expect("a footprint");
        house.begin();
        house.walls(None).expect("walls");
        let roof = [("kind", text("hip")), ("overhang", number(0.6))];
        house.roof(Some(Arc::new(table(&roof)).into())).expect("a roof");
        house.notes.iter().map(|note| format!("{}: {}", note.message(), note.cause())).collect::<Vec<_>>()
    };
    assert_eq!(notes(&[&angle]), [""; 0]);
    assert_eq!(
        notes(&[&angle, &beside]),
        ["a smaller overhang over some edges, as a neighbour is near: 0 m instead of 0.6 m over edge 3"]
    );
    let within = notes(&[&recess, &ring(&[(30., 0.), (40., 0.), (40., 5.), (30., 5.)])]);
    assert!(within.len() == 1 && within[0].contains("as the space is too small: "), "{within:?}");
}
