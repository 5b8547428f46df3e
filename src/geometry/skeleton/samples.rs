//! Random plans of the sorts that buildings come in, and of sorts that are hard.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::super::Plan;

/// Random numbers, always the same.
pub(in crate::geometry) struct Random(pub u64);

impl Random {
    /// From 0 to 1.
    #[allow(clippy::cast_precision_loss, reason = "a random number needs no more")]
    pub(in crate::geometry) fn next(&mut self) -> f64 {
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

type Ring = Vec<DVec2>;

/// A row of houses of several depths on both sides of a line, on whole metres: many ties.
fn row(random: &mut Random) -> Ring {
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

fn star(random: &mut Random) -> Ring {
    let count = random.whole(3, 24) as u32;
    let at = |index: u32, radius: f64| DVec2::from_angle(TAU * f64::from(index) / f64::from(count)) * radius;
    (0..count).map(|index| at(index, random.between(3.0, 12.0))).collect()
}

/// A wheel whose spokes are equal: everything meets at once.
fn wheel(random: &mut Random) -> Ring {
    let spokes = random.whole(2, 9) as u32;
    let (long, short) = (random.between(6.0, 12.0), random.between(2.0, 5.0));
    let count = 2 * spokes;
    let radius = |index: u32| if index.is_multiple_of(2) { long } else { short };
    let at = |index: u32| DVec2::from_angle(TAU * f64::from(index) / f64::from(count)) * radius(index);
    (0..count).map(at).collect()
}

/// A comb; with narrow gaps its slots are thin.
fn comb(random: &mut Random) -> Ring {
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

/// The ring with points that are almost on its edges, or with tiny steps in them.
fn worn(ring: &Ring, random: &mut Random) -> Ring {
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

/// A plan of the sort that `round` asks for; none where chance has made one that crosses itself.
pub(in crate::geometry) fn plan(round: usize, random: &mut Random) -> Option<Vec<Ring>> {
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
    let turn = DVec2::from_angle(if round.is_multiple_of(2) { 0.0 } else { random.between(0.0, TAU) });
    let turned = |ring: &Ring| -> Vec<DVec3> { ring.iter().map(|&at| turn.rotate(at).extend(0.0)).collect() };
    let rings: Vec<Vec<DVec3>> = rings.iter().map(turned).collect();
    Plan::new(&rings).ok().map(|plan| plan.flat())
}
