//! Families of geometries that are difficult for set operations, and checks of the results.

use burgeon_spatial::{BufferOptions, Geometry, union_all};
use glam::{DVec2, DVec3};

/// Locations at which each family is tested (m): the origin, a national grid, and far away.
pub(crate) const PLACES: [(&str, DVec2); 3] = [
    ("origin", DVec2::ZERO),
    ("national", DVec2::new(450_000.0, 6_800_000.0)),
    ("far", DVec2::new(1e7, 1e7)),
];

/// A family: its name, and a function that returns the defect of one case.
pub(crate) type Family = (&'static str, fn(&mut Dice, DVec2) -> Option<String>);

/// All families.
pub(crate) const FAMILIES: [Family; 8] = [
    ("rest of an oriented envelope", rest_of_envelope),
    ("turned neighbours", turned_neighbours),
    ("random pairs", random_pairs),
    ("nearly equal polygons", nearly_equal),
    ("slivers", slivers),
    ("buffers", buffers),
    ("touching holes", touching_holes),
    ("lines that fold back", folded_lines),
];

/// Random numbers (splitmix64).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// Returns a number from `low` to `high`.
    pub(crate) fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Returns an integer from `low` to `high`, both included.
    pub(crate) fn count(&mut self, low: u64, high: u64) -> u64 {
        low + self.next() % (high - low + 1)
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.count(0, all.len() as u64 - 1) as usize]
    }

    fn offset(&mut self, most: f64) -> DVec2 {
        DVec2::new(self.number(-most, most), self.number(-most, most))
    }
}

fn polygon(rings: Vec<Vec<DVec2>>) -> Geometry {
    let rings = rings.into_iter().map(|ring| ring.into_iter().map(|at| at.extend(0.0)).collect());
    Geometry::polygon(rings.collect::<Vec<Vec<DVec3>>>()).expect("a polygon")
}

fn star(dice: &mut Dice, middle: DVec2, radius: f64, corners: u64) -> Vec<DVec2> {
    let corner = |index: u64| {
        let angle = std::f64::consts::TAU * (index as f64 + dice.number(0.0, 0.8)) / corners as f64;
        middle + DVec2::from_angle(angle) * radius * dice.number(0.4, 1.0)
    };
    (0..corners).map(corner).collect()
}

/// Returns a valid polygon, sometimes with holes.
pub(crate) fn simple(dice: &mut Dice, middle: DVec2, radius: f64) -> Geometry {
    loop {
        let corners = dice.count(3, 14);
        let outer = star(dice, middle, radius, corners);
        let mut made = polygon(vec![outer.clone()]);
        let mut rings = vec![outer];
        for _ in 0..if dice.count(0, 9) < 4 { dice.count(1, 3) } else { 0 } {
            let (at, size) = (middle + dice.offset(0.4 * radius), radius * dice.number(0.05, 0.25));
            let corners = dice.count(3, 7);
            rings.push(star(dice, at, size, corners));
            let with = polygon(rings.clone());
            if with.is_valid() {
                made = with;
            } else {
                rings.pop();
            }
        }
        if made.is_valid() && made.area() > 0.0 {
            return made;
        }
    }
}

/// Returns the reason why one of the results is invalid.
fn invalid(made: &[(&str, &Geometry)]) -> Option<String> {
    made.iter().find_map(|(what, made)| made.validity_reason().map(|reason| format!("{what}: {reason}")))
}

/// Reports an area (m²) that differs from the expected one by more than 1e-9 of a size.
fn off(what: &str, found: f64, expected: f64, size: f64) -> Option<String> {
    ((found - expected).abs() > 1e-9 * size).then(|| format!("{what}: {found}, not {expected}"))
}

/// Returns the defect of the set operations on two areas.
pub(crate) fn all_operations(a: &Geometry, b: &Geometry) -> Option<String> {
    let (both, either) = (a.intersection(b), a.union(b));
    let (first, second, one) = (a.difference(b), b.difference(a), a.sym_difference(b));
    let made = [
        ("intersection", &both),
        ("union", &either),
        ("difference", &first),
        ("difference the other way", &second),
        ("symmetric difference", &one),
    ];
    let (size, common) = (a.area() + b.area(), both.area());
    invalid(&made)
        .or_else(|| off("union and intersection", either.area() + common, size, size))
        .or_else(|| off("difference", first.area() + common, a.area(), size))
        .or_else(|| off("difference the other way", second.area() + common, b.area(), size))
        .or_else(|| off("symmetric difference", one.area() + common, either.area(), size))
        .map(|wrong| format!("{wrong} of {a} and {b}"))
}

fn rest_of_envelope(dice: &mut Dice, place: DVec2) -> Option<String> {
    let radius = dice.of(&[1.0, 10.0, 100.0]);
    let at = place + dice.offset(100.0);
    let inner = simple(dice, at, radius);
    let outer = inner.oriented_envelope();
    let rest = outer.difference(&inner);
    invalid(&[("difference", &rest)])
        .or_else(|| off("rest", rest.area() + inner.area(), outer.union(&inner).area(), outer.area()))
        .map(|wrong| format!("{wrong} of {inner}"))
}

fn turned_neighbours(dice: &mut Dice, place: DVec2) -> Option<String> {
    let turn = DVec2::from_angle(dice.number(0.0, std::f64::consts::TAU));
    let origin = place + dice.offset(500.0);
    let at = |x: f64, y: f64| origin + turn.rotate(DVec2::new(x, y));
    let [w, d, w2, d2] = [(); 4].map(|()| dice.number(4.0, 20.0));
    let y = dice.number(0.1, 0.9) * d;
    let one = vec![at(0.0, 0.0), at(w, 0.0), at(w, d), at(0.0, d)];
    let (wall, far) = (|y: f64| at(w, y), |y: f64| at(w + w2, y));
    let other = match dice.count(0, 4) {
        0 => vec![wall(y), far(y), far(y + d2), wall(y + d2)],
        1 => vec![wall(0.0), far(0.0), far(d), wall(d), wall(y)],
        2 => vec![wall(y * 0.5), far(0.0), far(d2), wall(y)],
        3 => vec![wall(-y), far(-y), far(d + 3.0), wall(d + 3.0)],
        _ => vec![wall(y), far(y - 3.0), far(y + 3.0)],
    };
    let (one, other) = (polygon(vec![one]), polygon(vec![other]));
    if !other.is_valid() {
        return None;
    }
    all_operations(&one, &other)
}

fn random_pairs(dice: &mut Dice, place: DVec2) -> Option<String> {
    let radius = dice.of(&[1.0, 10.0, 100.0]);
    let one = simple(dice, place, radius);
    let (at, size) = (place + dice.offset(radius), radius * dice.number(0.3, 1.5));
    let other = simple(dice, at, size);
    all_operations(&one, &other)
}

/// Returns copies of a polygon that are moved by at most 2e-6 m, as a whole or corner by corner.
pub(crate) fn copies(dice: &mut Dice, place: DVec2, count: u64) -> Vec<Geometry> {
    let radius = dice.of(&[10.0, 100.0]);
    let first = simple(dice, place, radius);
    let copy = |dice: &mut Dice| {
        let mut copy = first.clone();
        let whole = (dice.count(0, 1) == 0).then(|| dice.offset(2e-6 / std::f64::consts::SQRT_2));
        for point in copy.points_mut() {
            *point += whole.unwrap_or_else(|| dice.offset(2e-6 / std::f64::consts::SQRT_2)).extend(0.0);
        }
        copy
    };
    (0..count).map(|_| copy(dice)).filter(Geometry::is_valid).collect()
}

fn nearly_equal(dice: &mut Dice, place: DVec2) -> Option<String> {
    let count = dice.count(50, 300);
    let all = copies(dice, place, count);
    let made = union_all(&all);
    let least = all.iter().map(Geometry::area).fold(0.0, f64::max);
    // No copy extends more than 4e-6 m beyond another.
    let most = least + 1e-5 * all[0].perimeter();
    let is_wrong = made.area() < least * (1.0 - 1e-9) || made.area() > most || made.num_geometries() != 1;
    invalid(&[("union", &made)])
        .or_else(|| is_wrong.then(|| format!("{}, not {least} to {most}", made.area())))
}

/// Tests areas that are narrower than 1e-9 of their extent, and wider than the rounding error of coordinates.
fn slivers(dice: &mut Dice, place: DVec2) -> Option<String> {
    let long = dice.of(&[10.0, 100.0, 1000.0]);
    let turn = DVec2::from_angle(dice.number(0.0, std::f64::consts::TAU));
    let at = |x: f64, y: f64| place + turn.rotate(DVec2::new(x, y));
    let rounding = place.abs().max_element().max(long) * f64::EPSILON;
    let wide = (long * 10f64.powf(dice.number(-12.0, -9.1))).max(8.0 * rounding);
    let ring = match dice.count(0, 2) {
        0 => vec![at(0.0, 0.0), at(long, 0.0), at(long, wide)],
        1 => vec![at(0.0, 0.0), at(long, 0.0), at(long, wide), at(0.0, wide)],
        _ => {
            let (x, y) = (0.1 * long, 0.05 * long);
            let head = [at(0.0, 0.0), at(x, 0.0), at(x, y)];
            let tail = [at(long, y), at(long, y + wide), at(x, y + wide), at(x, 2.0 * y), at(0.0, 2.0 * y)];
            head.into_iter().chain(tail).collect()
        }
    };
    let sliver = polygon(vec![ring]);
    if !sliver.is_valid() {
        return None;
    }
    let distance = dice.of(&[0.1, 1.0, 5.0]);
    let around = sliver.buffer(distance, &BufferOptions::default()).expect("a buffer");
    let length = at(0.0, 0.0).distance(at(long, 0.0));
    let apart =
        polygon(vec![[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| at(x + 1.1 * long, y)).to_vec()]);
    let both = sliver.union(&apart);
    let alone = union_all([&sliver]);
    let has_vanished = |made: &Geometry, area: f64| (made.area() / area - 1.0).abs() > 1e-3;
    invalid(&[("buffer", &around), ("union", &both), ("union alone", &alone)])
        .or_else(|| {
            (around.area() < 2.0 * distance * length).then(|| format!("the buffer has {} m²", around.area()))
        })
        .or_else(|| has_vanished(&alone, sliver.area()).then(|| "the sliver vanished".to_owned()))
        .or_else(|| {
            let left = both.difference(&apart);
            has_vanished(&left, sliver.area()).then(|| "the sliver vanished in a union".to_owned())
        })
        .map(|wrong| format!("{wrong}: {sliver}"))
}

fn buffers(dice: &mut Dice, place: DVec2) -> Option<String> {
    let radius = dice.of(&[1.0, 10.0, 100.0]);
    let one = simple(dice, place, radius);
    let other = simple(dice, place + DVec2::new(1.4 * radius, 0.0), radius);
    let area = one.union(&other);
    let distance = radius * dice.of(&[0.01, 0.1, 0.3, 1.0, 3.0]);
    let buffer =
        |of: &Geometry, distance: f64| of.buffer(distance, &BufferOptions::default()).expect("a buffer");
    let (outer, inner) = (buffer(&area, distance), buffer(&area, -0.3 * distance));
    let border = buffer(&area.boundary(), 0.3 * distance);
    let size = outer.area();
    invalid(&[("buffer", &outer), ("buffer inwards", &inner), ("buffer of the border", &border)])
        .or_else(|| off("area and buffer", outer.intersection(&area).area(), area.area(), size))
        .or_else(|| off("area and border", area.difference(&border).area(), inner.area(), size))
        .map(|wrong| format!("{wrong} at {distance} of {area}"))
}

/// Returns chains of holes that touch one another and sometimes the outer ring, and whether they divide the
/// area.
pub(crate) fn holes(dice: &mut Dice, place: DVec2) -> (Geometry, bool) {
    let (columns, rows) = (dice.count(2, 6), dice.count(2, 6));
    let corner = |x: u64, y: u64| DVec2::new(x as f64, y as f64);
    let turn = [DVec2::X, DVec2::Y, DVec2::new(0.5, 0.25)][dice.count(0, 2) as usize];
    // Powers of two and their sums are exact everywhere.
    let at = |at: DVec2| place + at.x * turn + at.y * turn.perp();
    let high = corner(columns, rows);
    let outer = [corner(0, 0), corner(columns, 0), high, corner(0, rows)];
    let mut rings = vec![outer.map(at).to_vec()];
    // Diamonds between the midpoints of the edges of cells: neighbours share a corner.
    let mut cells = vec![vec![false; rows as usize]; columns as usize];
    for x in 0..columns {
        for y in 0..rows {
            if dice.count(0, 9) < 4 {
                cells[x as usize][y as usize] = true;
                let middle = corner(x, y) + 0.5;
                let tips = [DVec2::NEG_X, DVec2::Y, DVec2::X, DVec2::NEG_Y];
                rings.push(tips.map(|tip| at(middle + tip * 0.5)).to_vec());
            }
        }
    }
    // Joined to neighbours and to the border; a second connection divides the area.
    let count = (columns * rows) as usize;
    let mut first: Vec<usize> = (0..=count).collect();
    fn root(first: &[usize], mut index: usize) -> usize {
        while first[index] != index {
            index = first[index];
        }
        index
    }
    let number = |x: u64, y: u64| (x * rows + y) as usize;
    let mut is_divided = false;
    let mut join = |a: usize, b: usize| {
        let (a, b) = (root(&first, a), root(&first, b));
        is_divided |= a == b;
        first[a] = b;
    };
    for x in 0..columns {
        for y in 0..rows {
            if !cells[x as usize][y as usize] {
                continue;
            }
            let is_hole = |x: u64, y: u64| x < columns && y < rows && cells[x as usize][y as usize];
            if is_hole(x + 1, y) {
                join(number(x, y), number(x + 1, y));
            }
            if is_hole(x, y + 1) {
                join(number(x, y), number(x, y + 1));
            }
            for is_at_border in [x == 0, y == 0, x + 1 == columns, y + 1 == rows] {
                if is_at_border {
                    join(number(x, y), count);
                }
            }
        }
    }
    (polygon(rings), is_divided)
}

fn touching_holes(dice: &mut Dice, place: DVec2) -> Option<String> {
    let (area, is_divided) = holes(dice, place);
    if area.is_valid() == is_divided {
        return Some(format!("valid: {}, in several parts: {is_divided}: {area}", area.is_valid()));
    }
    let made = area.make_valid();
    let inner = made.buffer(-0.05, &BufferOptions::default()).expect("a buffer");
    let outer = made.buffer(0.05, &BufferOptions::default()).expect("a buffer");
    invalid(&[("made valid", &made), ("buffer inwards", &inner), ("buffer", &outer)])
        .or_else(|| off("made valid", made.area(), area.area(), area.area()))
        .or_else(|| (is_divided != (made.num_geometries() > 1)).then(|| "its parts".to_owned()))
        .map(|wrong| format!("{wrong}: {area}"))
}

fn folded_lines(dice: &mut Dice, place: DVec2) -> Option<String> {
    let turn = DVec2::from_angle(dice.number(0.0, std::f64::consts::TAU));
    let at = |x: f64, y: f64| (place + turn.rotate(DVec2::new(x, y))).extend(0.0);
    let (there, back) = (at(10.0, 0.0), at(dice.number(1.0, 9.0), 0.0));
    let repeats = dice.count(1, 3) as usize;
    let mut line = vec![at(0.0, 0.0)];
    line.extend(std::iter::repeat_n(there, repeats));
    line.push(back);
    let options = BufferOptions::default();
    let folded = Geometry::Line(line.clone()).buffer(1.0, &options).expect("a buffer");
    let straight = Geometry::Line(vec![line[0], there]).buffer(1.0, &options).expect("a buffer");
    invalid(&[("buffer", &folded)])
        .or_else(|| ((folded.area() / straight.area() - 1.0).abs() > 1e-6).then(|| folded.area().to_string()))
        .map(|wrong| format!("{wrong}, not {}", straight.area()))
}
