//! Tests of straight skeletons.

use super::*;

fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
}

fn hip(rings: &[Vec<DVec2>]) -> Skeleton {
    let speeds = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
    Skeleton::new(rings, &speeds).expect("a skeleton")
}

/// Random numbers from 0 to 1, always the same.
struct Random(u64);

impl Random {
    #[allow(clippy::cast_precision_loss, reason = "a random number needs no more")]
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn whole(&mut self, from: u32, to: u32) -> f64 {
        f64::from(from) + (self.next() * f64::from(to - from + 1)).floor()
    }
}

/// A row of houses of several depths on both sides of a street's line, on whole metres: many ties.
fn orthogonal(random: &mut Random) -> Vec<DVec2> {
    let count = random.whole(1, 6) as usize;
    let (mut x, mut low, mut high) = (0.0, Vec::new(), Vec::new());
    for _ in 0..count {
        let width = random.whole(1, 6);
        let (down, up) = (-random.whole(1, 6), random.whole(1, 6));
        low.extend([DVec2::new(x, down), DVec2::new(x + width, down)]);
        high.extend([DVec2::new(x, up), DVec2::new(x + width, up)]);
        x += width;
    }
    low.extend(high.into_iter().rev());
    let count = low.len();
    let corner = |index: usize| {
        let [a, b, c] = [count - 1, 0, 1].map(|offset| low[(index + offset) % count]);
        (b - a).perp_dot(c - b).abs() > 1e-9
    };
    let mut ring: Vec<DVec2> = low.clone();
    ring.dedup();
    let kept = (0..count).filter(|&index| low[index] != low[(index + 1) % count] && corner(index));
    let kept: Vec<DVec2> = kept.map(|index| low[index]).collect();
    if kept.len() >= 4 && kept.len().is_multiple_of(2) { kept } else { ring }
}

fn star(random: &mut Random) -> Vec<DVec2> {
    let count = random.whole(3, 24);
    let at = |index: u32, radius: f64| {
        DVec2::from_angle(std::f64::consts::TAU * f64::from(index) / count) * radius
    };
    (0..count as u32).map(|index| at(index, 3.0 + 9.0 * random.next())).collect()
}

#[test]
fn random_plans_have_sound_roofs_with_few_repairs() {
    let mut random = Random(7);
    let (mut moved, mut count) = (0, 0);
    for round in 0..3000 {
        let plain = if round % 2 == 0 { orthogonal(&mut random) } else { star(&mut random) };
        let angle = if round % 4 < 2 { 0.0 } else { random.next() * 6.0 };
        let turned = |ring: &[DVec2]| -> Vec<DVec2> {
            ring.iter().map(|&at| DVec2::from_angle(angle).rotate(at)).collect()
        };
        let half = 0.2 + 0.7 * random.next();
        let hole = [(-half, -half), (-half, half), (half, half), (half, -half)].map(DVec2::from);
        let offset = if round % 2 == 0 { DVec2::new(0.5, 0.0) } else { DVec2::ZERO };
        let hole: Vec<DVec2> =
            hole.iter().map(|&at| at * if round % 2 == 0 { 0.5 } else { 1.0 } + offset).collect();
        let plans = [vec![turned(&plain)], vec![turned(&plain), turned(&hole)]];
        let rings = &plans[usize::from(round % 3 == 0)];
        let speeds = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
        let found = Skeleton::new(rings, &speeds).unwrap_or_else(|error| panic!("{error}: {rings:?}"));
        moved += u32::from(found.moved);
        count += 1;
    }
    assert_eq!(count, 3000);
    assert!(moved <= 30, "{moved} plans had to be moved");
}

#[test]
fn a_comb_of_400_teeth_is_roofed() {
    let mut comb = Vec::new();
    for tooth in 0..400 {
        let x = 2.0 * f64::from(tooth);
        comb.extend([(x, -5.0), (x + 1.0, -5.0), (x + 1.0, 0.0), (x + 2.0, 0.0)]);
    }
    comb.pop();
    comb.pop();
    comb.extend([(799.0, 5.0), (0.0, 5.0)]);
    let found = hip(&[ring(&comb)]);
    assert_eq!((found.faces.len(), found.moved), (comb.len(), false));
}

#[test]
fn a_square_an_l_and_a_courtyard_have_their_ridges() {
    let square = hip(&[ring(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)])]);
    assert_eq!((square.peaks.len(), square.duration()), (5, 1.0));
    let l = hip(&[ring(&[(0., 0.), (6., 0.), (6., 2.), (2., 2.), (2., 6.), (0., 6.)])]);
    assert_eq!(l.duration(), 1.0);
    let u = hip(&[
        ring(&[(0., 0.), (9., 0.), (9., 9.), (0., 9.)]),
        ring(&[(3., 3.), (3., 6.), (6., 6.), (6., 3.)]),
    ]);
    assert_eq!(u.duration(), 1.5);
}
