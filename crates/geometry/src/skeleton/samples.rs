//! Random plans of typical and of difficult buildings, shared by tests and benches.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Reproducible random numbers.
pub(crate) struct Random(pub u64);

impl Random {
    /// Returns the next number, from 0 to 1.
    #[allow(clippy::cast_precision_loss, reason = "a random number needs no more")]
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    fn whole(&mut self, from: u32, to: u32) -> f64 {
        f64::from(from) + (self.next() * f64::from(to - from + 1)).floor()
    }
}

type Points = Vec<DVec2>;

/// Returns a row of houses of several depths on both sides of a line, on whole metres, with many simultaneous
/// events.
fn row(random: &mut Random) -> Points {
    let (mut x, mut low, mut high) = (0.0, Vec::new(), Vec::new());
    for _ in 0..random.whole(1, 6) as usize {
        let width = random.whole(1, 6);
        let (down, up) = (-random.whole(1, 6), random.whole(1, 6));
        low.extend([DVec2::new(x, down), DVec2::new(x + width, down)]);
        high.extend([DVec2::new(x, up), DVec2::new(x + width, up)]);
        x += width;
    }
    low.extend(high.into_iter().rev());
    low
}

fn star(random: &mut Random) -> Points {
    let count = random.whole(3, 24) as u32;
    let at = |index: u32, radius: f64| DVec2::from_angle(TAU * f64::from(index) / f64::from(count)) * radius;
    (0..count).map(|index| at(index, random.between(3.0, 12.0))).collect()
}

/// Returns a wheel with equal spokes: all events are simultaneous.
fn wheel(random: &mut Random) -> Points {
    let spokes = random.whole(2, 9) as u32;
    let (long, short) = (random.between(6.0, 12.0), random.between(2.0, 5.0));
    let count = 2 * spokes;
    let radius = |index: u32| if index.is_multiple_of(2) { long } else { short };
    let at = |index: u32| DVec2::from_angle(TAU * f64::from(index) / f64::from(count)) * radius(index);
    (0..count).map(at).collect()
}

/// Returns a comb; narrow gaps make thin slots.
fn comb(random: &mut Random) -> Points {
    let gap = [0.03, 0.3, 1.0][random.whole(0, 2) as usize];
    let (teeth, width) = (random.whole(2, 12) as u32, random.whole(1, 3));
    let mut ring = Vec::new();
    for tooth in 0..teeth {
        let x = (width + gap) * f64::from(tooth);
        let long = if random.next() < 0.5 { -5.0 } else { -random.whole(1, 6) };
        ring.extend([(x, 0.0), (x, long), (x + width, long), (x + width, 0.0)]);
    }
    let right = (width + gap) * f64::from(teeth) - gap;
    ring.extend([(right, 4.0), (0.0, 4.0)]);
    ring.into_iter().map(DVec2::from).collect()
}

/// Returns the ring with points that are almost on its edges, or with tiny steps.
fn worn(ring: &Points, random: &mut Random) -> Points {
    let mut worn = Vec::new();
    for (index, &a) in ring.iter().enumerate() {
        let b = ring[(index + 1) % ring.len()];
        let (way, out) = (b - a, (b - a).normalize_or_zero().perp() * random.between(-0.08, 0.08));
        worn.push(a);
        match random.whole(0, 3) as u32 {
            0 => worn.push(a + way * random.next() + out * 0.1),
            1 => worn.extend([
                a + way * 0.4 + out * 0.0,
                a + way * 0.4 + out,
                a + way * 0.7 + out,
                a + way * 0.7,
            ]),
            _ => {}
        }
    }
    worn
}

/// Returns random rings of the type selected by `round`; some of them cross themselves.
pub(crate) fn mixed(round: usize, random: &mut Random) -> Vec<Points> {
    let mut outer = match round % 5 {
        0 | 1 => row(random),
        2 => star(random),
        3 => wheel(random),
        _ => comb(random),
    };
    if round % 3 == 1 {
        outer = worn(&outer, random);
    }
    let mut rings = vec![outer];
    if round.is_multiple_of(4) {
        let (half, middle) = (random.between(0.1, 0.9), DVec2::new(0.5 + f64::from(round % 5 == 4), 0.0));
        let corners = [(-half, -half), (-half, half), (half, half), (half, -half)];
        rings.push(corners.iter().map(|&corner| middle + DVec2::from(corner) * 0.5).collect());
    }
    if round.is_multiple_of(2) { rings } else { turned(&rings, random.between(0.0, TAU)) }
}

/// A family of regular plans with simultaneous or nearly simultaneous events.
pub(crate) struct Family {
    /// Description.
    pub name: &'static str,
    /// Creates a plan of the family.
    pub make: fn(&mut Random) -> Vec<Points>,
}

/// All families of regular plans.
pub(crate) const FAMILIES: [Family; 18] = [
    Family { name: "double combs, noise of 0.5 mm", make: |random| noisy(double_comb(random), 5e-4, random) },
    Family { name: "double combs, noise of 1 mm", make: |random| noisy(double_comb(random), 1e-3, random) },
    Family { name: "double combs, noise of 3 mm", make: |random| noisy(double_comb(random), 3e-3, random) },
    Family { name: "double combs, noise of 10 mm", make: |random| noisy(double_comb(random), 1e-2, random) },
    Family { name: "double combs, exact or nearly so", make: |random| anyhow(double_comb(random), random) },
    Family { name: "courtyards, noise of 1 mm", make: |random| noisy(courtyards(random), 1e-3, random) },
    Family { name: "courtyards, noise of 5 mm", make: |random| noisy(courtyards(random), 5e-3, random) },
    Family { name: "courtyards, noise of 20 mm", make: |random| noisy(courtyards(random), 2e-2, random) },
    Family { name: "grids of courtyards, exact", make: grid },
    Family { name: "grids of courtyards, noise of 1 mm", make: |random| noisy(grid(random), 1e-3, random) },
    Family {
        name: "grids of courtyards, turned or nearly exact",
        make: |random| anyhow(grid(random), random),
    },
    Family { name: "lattice plans, exact", make: lattice },
    Family { name: "lattice plans, nearly exact", make: |random| anyhow(lattice(random), random) },
    Family { name: "lattice plans, off by as much as rounding", make: rounded },
    Family { name: "regular polygons", make: |random| anyhow(regular(random), random) },
    Family { name: "wheels", make: |random| anyhow(vec![wheel(random)], random) },
    Family { name: "combs of narrow gaps", make: |random| anyhow(vec![comb(random)], random) },
    Family { name: "rows of houses", make: |random| anyhow(vec![row(random)], random) },
];

/// Returns the rings unchanged, rotated, or with noise of up to 20 mm.
fn anyhow(rings: Vec<Points>, random: &mut Random) -> Vec<Points> {
    let noise = [0.0, 0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 2e-2][random.whole(0, 7) as usize];
    let rings = noisy(rings, noise, random);
    let turn = [0.0, PI / 4.0, random.between(0.0, TAU)][random.whole(0, 2) as usize];
    if turn == 0.0 { rings } else { turned(&rings, turn) }
}

/// Returns a plan on a lattice, rotated or not, with coordinates off by up to 1e-9 m to 1e-6 m.
pub(crate) fn rounded(random: &mut Random) -> Vec<Points> {
    let noise = 10f64.powf(-random.between(6.0, 9.0));
    let rings = noisy(lattice(random), noise, random);
    let turn = [0.0, PI / 4.0, random.between(0.0, TAU)][random.whole(0, 2) as usize];
    if turn == 0.0 { rings } else { turned(&rings, turn) }
}

/// Returns the speed and the initial rest (m) of 400 edges: some stand still forever, some for a while, and
/// no two consecutive ones.
pub(crate) fn still(random: &mut Random) -> Vec<[f64; 2]> {
    let mut last = 1.0;
    let pace = |chance: f64| {
        let chance = if last < 0.2 { 1.0 } else { chance };
        last = chance;
        match chance {
            chance if chance < 0.1 => [0.0, 0.0],
            chance if chance < 0.15 => [1.0, (chance * 1024.0).round() / 64.0],
            _ => [1.0, 0.0],
        }
    };
    (0..400).map(|_| random.next()).map(pace).collect()
}

fn turned(rings: &[Points], angle: f64) -> Vec<Points> {
    let turn = DVec2::from_angle(angle);
    rings.iter().map(|ring| ring.iter().map(|&at| turn.rotate(at)).collect()).collect()
}

/// Moves every coordinate of the rings by up to `most` (m).
pub(crate) fn noisy(mut rings: Vec<Points>, most: f64, random: &mut Random) -> Vec<Points> {
    for at in rings.iter_mut().flatten() {
        *at += DVec2::new(random.between(-most, most), random.between(-most, most));
    }
    rings
}

fn rectangle(low: DVec2, high: DVec2) -> Points {
    vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

/// Returns equal pavilions on both sides of a corridor.
fn double_comb(random: &mut Random) -> Vec<Points> {
    let half = |random: &mut Random, from: u32, to: u32| random.whole(2 * from, 2 * to) / 2.0;
    let (count, width, gap) = (random.whole(2, 10) as u32, half(random, 4, 10), half(random, 3, 10));
    let (deep, corridor) = (half(random, 4, 14), half(random, 2, 6));
    let (up, down) = (deep, if random.next() < 0.7 { deep } else { half(random, 4, 14) });
    let shift = if random.next() < 0.7 { 0.0 } else { random.whole(0, 3) / 2.0 };
    let right = (width + gap) * f64::from(count) - gap;
    let (mut low, mut high) = (Points::new(), Points::new());
    for tooth in 0..count {
        let x = (width + gap) * f64::from(tooth);
        low.extend([(x, 0.0), (x, -down), (x + width, -down), (x + width, 0.0)].map(DVec2::from));
        let (from, to) = (x + shift, x + width + shift);
        let y = corridor;
        high.extend([(from, y), (from, y + up), (to, y + up), (to, y)].map(DVec2::from));
    }
    // The ends of the corridor and of the adjacent pavilions form one edge.
    low.remove(0);
    high.pop();
    if shift == 0.0 {
        low.pop();
        high.remove(0);
    } else {
        low.push(DVec2::new(right + shift, 0.0));
        high.insert(0, DVec2::new(0.0, corridor));
    }
    low.extend(high.into_iter().rev());
    vec![low]
}

/// Returns 1 to 20 equal courtyards with wings of 6 to 8 m around and between them.
fn courtyards(random: &mut Random) -> Vec<Points> {
    let count = random.whole(1, 20) as u32;
    let columns = random.whole(1, count.min(7)) as u32;
    let (wing, wide, deep) =
        (random.whole(12, 16) / 2.0, random.whole(6, 24) / 2.0, random.whole(6, 24) / 2.0);
    yards(count.div_ceil(columns), columns, wing, DVec2::new(wide, deep))
}

/// Returns a grid of equal courtyards on whole metres, many of them square.
fn grid(random: &mut Random) -> Vec<Points> {
    let (rows, columns) = (random.whole(1, 5) as u32, random.whole(1, 5) as u32);
    let (wing, wide) = (random.whole(4, 10), random.whole(4, 12));
    let deep = if random.next() < 0.5 { wide } else { random.whole(4, 12) };
    yards(rows, columns, wing, DVec2::new(wide, deep))
}

fn yards(rows: u32, columns: u32, wing: f64, yard: DVec2) -> Vec<Points> {
    let step = yard + DVec2::splat(wing);
    let size = step * DVec2::new(f64::from(columns), f64::from(rows)) + DVec2::splat(wing);
    let mut rings = vec![rectangle(DVec2::ZERO, size)];
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let low = step * DVec2::new(f64::from(column), f64::from(row)) + DVec2::splat(wing);
        rings.push(rectangle(low, low + yard).into_iter().rev().collect());
    }
    rings
}

/// Returns random plans on whole metres, with holes: unions of squares of a lattice, some with chamfered
/// corners.
fn lattice(random: &mut Random) -> Vec<Points> {
    const SIZE: usize = 9;
    let mut filled = [[false; SIZE + 2]; SIZE + 2];
    let (wide, deep) = (random.whole(2, SIZE as u32) as usize, random.whole(2, SIZE as u32) as usize);
    let (mut x, mut y) = (1 + wide / 2, 1 + deep / 2);
    for _ in 0..random.whole(2, 60) as usize {
        filled[y][x] = true;
        match random.whole(0, 3) as u32 {
            0 if x > 1 => x -= 1,
            1 if x < wide => x += 1,
            2 if y > 1 => y -= 1,
            3 if y < deep => y += 1,
            _ => {}
        }
    }
    // Squares that touch only at a corner are joined by a third.
    let touches = |filled: &[[bool; SIZE + 2]; SIZE + 2], x: usize, y: usize| {
        let [a, b, c, d] = [filled[y][x], filled[y][x + 1], filled[y + 1][x + 1], filled[y + 1][x]];
        a == c && b == d && a != b
    };
    let places = || (0..=SIZE).flat_map(|y| (0..=SIZE).map(move |x| (x, y)));
    while let Some((x, y)) = places().find(|&(x, y)| touches(&filled, x, y)) {
        (filled[y][x.max(1)], filled[y + 1][x.max(1)]) = (true, true);
    }
    let step = DVec2::new(random.whole(1, 6), random.whole(1, 6));
    let cut = if random.next() < 0.3 { step.min_element() / 2.0 } else { 0.0 };
    let mut rings = outlines(|x, y| filled[y][x], SIZE + 2);
    for ring in &mut rings {
        ring.iter_mut().for_each(|at| *at *= step);
        if cut > 0.0 {
            let count = ring.len();
            let chance: Vec<bool> = (0..count).map(|_| random.next() < 0.4).collect();
            let corner = |index: usize| {
                let (at, before) = (ring[index], ring[(index + count - 1) % count]);
                let after = ring[(index + 1) % count];
                let near = |other: DVec2| at + (other - at).normalize_or_zero() * (cut * 0.75);
                if chance[index] { vec![near(before), near(after)] } else { vec![at] }
            };
            *ring = (0..count).flat_map(corner).collect();
        }
    }
    rings
}

/// Returns the corners of the rings around squares, the outer ring first.
fn outlines(filled: impl Fn(usize, usize) -> bool, size: usize) -> Vec<Points> {
    let mut ways: Vec<[(usize, usize); 2]> = Vec::new();
    for (x, y) in (1..size).flat_map(|y| (1..size).map(move |x| (x, y))) {
        let here = filled(x, y);
        if here != filled(x, y - 1) {
            ways.push(if here { [(x, y), (x + 1, y)] } else { [(x + 1, y), (x, y)] });
        }
        if here != filled(x - 1, y) {
            ways.push(if here { [(x, y + 1), (x, y)] } else { [(x, y), (x, y + 1)] });
        }
    }
    let mut rings: Vec<Points> = Vec::new();
    while let Some([first, mut at]) = ways.pop() {
        let mut ring = vec![first];
        while at != first {
            ring.push(at);
            let Some(next) = ways.iter().position(|way| way[0] == at) else { break };
            at = ways.swap_remove(next)[1];
        }
        #[allow(clippy::cast_precision_loss, reason = "they are few")]
        let ring: Points = ring.into_iter().map(|(x, y)| DVec2::new(x as f64, y as f64)).collect();
        let count = ring.len();
        let turns = |index: usize| {
            let (before, at) = (ring[(index + count - 1) % count], ring[index]);
            (at - before).perp_dot(ring[(index + 1) % count] - at) != 0.0
        };
        rings.push((0..count).filter(|&index| turns(index)).map(|index| ring[index]).collect());
    }
    let left = |ring: &Points| ring.iter().map(|at| at.x).fold(f64::INFINITY, f64::min);
    rings.sort_by(|a, b| left(a).total_cmp(&left(b)));
    rings
}

/// Returns a regular polygon of 3 to 60 corners, some with a courtyard of the same shape.
fn regular(random: &mut Random) -> Vec<Points> {
    let count = random.whole(3, 60) as u32;
    let ring = |radius: f64| -> Points {
        (0..count)
            .map(|index| DVec2::from_angle(TAU * f64::from(index) / f64::from(count)) * radius)
            .collect()
    };
    let mut rings = vec![ring(12.0)];
    if random.next() < 0.3 {
        rings.push(ring(random.between(3.0, 5.0)).into_iter().rev().collect());
    }
    rings
}
