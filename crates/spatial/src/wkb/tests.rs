//! Tests of the reader of well-known binary, and tests that no input makes it panic.

use burgeon_base::budget::Budget;
use glam::DVec3;

use super::{NEAR, read};
use crate::Geometry;

/// Returns well-known binary made of words and numbers.
fn body(little: bool, code: u32, words: &[Result<f64, u32>]) -> Vec<u8> {
    let mut bytes = vec![u8::from(little)];
    for word in [Err(code)].iter().chain(words) {
        match (word, little) {
            (Ok(number), true) => bytes.extend(number.to_le_bytes()),
            (Ok(number), false) => bytes.extend(number.to_be_bytes()),
            (Err(word), true) => bytes.extend(word.to_le_bytes()),
            (Err(word), false) => bytes.extend(word.to_be_bytes()),
        }
    }
    bytes
}

fn parts(bytes: &[u8]) -> Result<Vec<Geometry>, String> {
    read(bytes, NEAR, &Budget::default()).map(Geometry::into_parts)
}

#[test]
fn points_are_read_in_both_byte_orders_with_z_and_m() {
    for little in [true, false] {
        let xy = [Ok(1.0), Ok(2.0)];
        let cases: [(u32, Vec<_>, f64); 6] = [
            (1, xy.to_vec(), 0.0),
            (1001, [&xy[..], &[Ok(3.0)]].concat(), 3.0),
            (2001, [&xy[..], &[Ok(9.0)]].concat(), 0.0),
            (3001, [&xy[..], &[Ok(3.0), Ok(9.0)]].concat(), 3.0),
            (0x8000_0001, [&xy[..], &[Ok(3.0)]].concat(), 3.0),
            (0xe000_0001, [&[Err(4326)], &xy[..], &[Ok(3.0), Ok(9.0)]].concat(), 3.0),
        ];
        for (code, words, z) in &cases {
            let read = parts(&body(little, *code, words));
            assert_eq!(read, Ok(vec![Geometry::point([1.0, 2.0, *z])]), "{code}");
        }
    }
}

#[test]
fn empty_geometries_have_no_parts() {
    let nan = Ok(f64::NAN);
    for (code, words) in [(1, vec![nan, nan]), (2, vec![Err(0)]), (3, vec![Err(0)]), (6, vec![Err(0)])] {
        assert_eq!(parts(&body(true, code, &words)), Ok(Vec::new()), "{code}");
    }
}

#[test]
fn what_is_cut_short_or_wrong_is_refused_without_asking_for_memory() {
    let ring = [Err(1), Err(4), Ok(0.0), Ok(0.0), Ok(1.0), Ok(0.0), Ok(1.0), Ok(1.0), Ok(0.0), Ok(0.0)];
    let whole = body(true, 3, &ring);
    assert!(matches!(&parts(&whole).unwrap()[..], [Geometry::Polygon(rings)] if rings[0].len() == 3));
    for end in 0..whole.len() {
        assert!(parts(&whole[..end]).is_err(), "{end}");
    }
    for code in [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16, 17] {
        assert!(parts(&body(true, code, &[Err(u32::MAX)])).is_err(), "{code}");
    }
    for code in [0, 13, 14, 18, 99, 4001] {
        assert!(parts(&body(true, code, &[Err(0)])).is_err(), "{code}");
    }
    // A multi-polygon within a multi-polygon could nest without limit.
    let nested = body(true, 6, &[Err(1)]).into_iter().chain(body(true, 6, &[Err(0)])).collect::<Vec<_>>();
    assert!(parts(&nested).is_err());
}
/// Returns well-known binary of a type, with its parts after their number.
fn of_parts(code: u32, parts: &[Vec<u8>]) -> Vec<u8> {
    let count = u32::try_from(parts.len()).unwrap();
    [body(true, code, &[Err(count)]), parts.concat()].concat()
}

fn of_points(code: u32, points: &[[f64; 2]]) -> Vec<u8> {
    let count = Err(u32::try_from(points.len()).unwrap());
    let words: Vec<_> = std::iter::once(count).chain(points.iter().flatten().map(|it| Ok(*it))).collect();
    body(true, code, &words)
}

#[test]
fn curves_and_collections_become_lines_and_polygons() {
    let read = |body: &[u8]| parts(body).unwrap();
    let straight = of_points(2, &[[0.0, 0.0], [4.0, 0.0]]);
    let half = of_points(8, &[[4.0, 0.0], [2.0, 2.0], [0.0, 0.0]]);
    let compound = of_parts(9, &[straight.clone(), half.clone()]);
    let [Geometry::Line(line)] = &read(&compound)[..] else { panic!("a line") };
    assert_eq!((line[0], line[1], line.last()), (DVec3::ZERO, DVec3::X * 4.0, Some(&DVec3::ZERO)));
    assert!(line.len() > 10 && line[1..].iter().all(|it| ((it[0] - 2.0).hypot(it[1]) - 2.0).abs() < 1e-9));
    let disc = of_parts(10, std::slice::from_ref(&compound));
    let [Geometry::Polygon(rings)] = &read(&disc)[..] else { panic!("a polygon") };
    assert_eq!(rings[0].len(), line.len() - 1);
    let ring = of_points(2, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
    let square = of_parts(3, &[ring[5..].to_vec()]);
    let all = of_parts(
        7,
        &[
            body(true, 1, &[Ok(0.0), Ok(0.0)]),
            of_parts(11, &[straight.clone(), half.clone(), compound]),
            of_parts(12, &[disc, square.clone()]),
            of_parts(16, &[]),
            of_parts(15, std::slice::from_ref(&square)),
        ],
    );
    let kinds: Vec<_> = read(&all).iter().map(|part| part.kind().name()).collect();
    assert_eq!(kinds, ["point", "line", "line", "line", "polygon", "polygon", "polygon"]);
    // A circular string of two points and a compound curve with a polygon are invalid.
    assert!(parts(&of_parts(9, &[square])).is_err());
    assert!(parts(&of_points(8, &[[0.0, 0.0], [1.0, 1.0]])).is_err());
    let mut nested = of_parts(7, &[]);
    for _ in 0..1000 {
        nested = of_parts(7, &[nested]);
    }
    assert!(parts(&nested).unwrap_err().contains("nested more than 32 deep"));
}

#[test]
fn geometries_have_no_room_left_over() {
    let text = "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 2, 2 1, 1 1)), ((20 0, 29 0, 29 9, 20 0)))";
    let mut geometry = Geometry::from_wkb(&Geometry::from_wkt(text).unwrap().to_wkb()).unwrap();
    let room = |geometry: &Geometry| {
        let Geometry::MultiPolygon(polygons) = geometry else { panic!("{geometry:?}") };
        let rings = polygons.iter().flat_map(|rings| rings.iter());
        rings.map(|ring| (ring.len(), ring.capacity())).collect::<Vec<_>>()
    };
    assert_eq!(room(&geometry), [(4, 4), (3, 3), (3, 3)]);
    let Geometry::MultiPolygon(polygons) = &mut geometry else { return };
    polygons[0].0[0].reserve(50);
    let before = geometry.clone();
    geometry.compact();
    assert_eq!(room(&geometry), [(4, 4), (3, 3), (3, 3)]);
    assert_eq!(geometry, before);
}

#[test]
fn changed_bytes_never_make_it_panic() {
    let straight = of_points(2, &[[0.0, 0.0], [4.0, 0.0]]);
    let half = of_points(8, &[[4.0, 0.0], [2.0, 2.0], [0.0, 0.0]]);
    let disc = of_parts(10, &[of_parts(9, &[straight.clone(), half.clone()])]);
    let whole = of_parts(7, &[of_parts(12, &[disc]), of_parts(11, &[straight, half])]);
    let (mut good, mut bad) = (0, 0);
    for at in 0..whole.len() {
        for byte in 0..=255 {
            let mut changed = whole.clone();
            changed[at] = byte;
            match parts(&changed) {
                Ok(_) => good += 1,
                Err(_) => bad += 1,
            }
        }
    }
    assert!(good > 10_000 && bad > 1000, "{good} {bad}");
}
