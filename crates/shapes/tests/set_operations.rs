//! Volumes of random chains of set operations.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::f64::consts::PI;

use burgeon_shapes::{Shape, SolidOperation};
use glam::{DVec2, DVec3};

/// Numbers from 0 to 1, the same in every run.
///
/// Method: splitmix64.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: u32) -> u32 {
        (self.next() * f64::from(count)) as u32
    }

    fn uniform(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// Returns a length of whole or half metres, or any length.
    fn length(&mut self, from: f64, to: f64) -> f64 {
        let any = self.uniform(from, to);
        match self.below(3) {
            0 => any,
            1 => (any * 2.0).round() / 2.0,
            _ => any.round(),
        }
    }

    fn size(&mut self) -> f64 {
        self.length(1.0, 10.0).max(1.0)
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(u32::try_from(all.len()).unwrap()) as usize]
    }
}

/// Returns a box, a prism, a star, a cylinder, a ball or a cone of 1 to 10 m at the origin.
fn primitive(numbers: &mut Numbers) -> Shape {
    match numbers.below(6) {
        0 | 1 => {
            let size = DVec3::new(numbers.size(), numbers.size(), numbers.size());
            Shape::cuboid(size).translate(-size / 2.0)
        }
        2 => {
            let count = 3 + numbers.below(6);
            let radius = numbers.size() / 2.0;
            let is_star = numbers.below(2) == 0;
            let corner = |index: u32| {
                let angle = PI * f64::from(index) / f64::from(count);
                let radius = if is_star && index % 2 == 1 { radius / 2.0 } else { radius };
                DVec2::new(angle.cos(), angle.sin()) * radius
            };
            let ring: Vec<DVec2> = (0..count * 2).map(corner).collect();
            Shape::plan(&[ring], 0.0).unwrap().extrude(numbers.size(), None).unwrap()
        }
        3 => {
            let radius = numbers.size() / 2.0;
            Shape::cylinder(radius, radius, numbers.size(), numbers.one_of(&[8, 12, 16, 24, 32])).unwrap()
        }
        4 => Shape::sphere(numbers.size() / 2.0, numbers.one_of(&[8, 12, 16, 24])).unwrap(),
        _ => {
            let top = if numbers.below(2) == 0 { 0.0 } else { numbers.size() / 2.0 };
            let radius = numbers.size() / 2.0;
            Shape::cylinder(radius, top, numbers.size(), numbers.one_of(&[6, 8, 12, 20])).unwrap()
        }
    }
}

/// Returns a primitive that is turned, by a multiple of 15 degrees or by any angle, and moved, some of them by a tiny distance.
fn part(numbers: &mut Numbers) -> Shape {
    let solid = primitive(numbers);
    let axis = numbers.one_of(&[DVec3::X, DVec3::Y, DVec3::Z]);
    let solid = match numbers.below(4) {
        0 | 1 => solid,
        2 => solid.rotate(DVec3::ZERO, axis, f64::from(numbers.below(24)) * PI / 12.0),
        _ => {
            let mut side = || numbers.uniform(-1.0, 1.0);
            let axis = DVec3::new(side(), side(), side()).normalize();
            solid.rotate(DVec3::ZERO, axis, numbers.uniform(-PI, PI))
        }
    };
    let mut offset =
        DVec3::new(numbers.length(-4.0, 4.0), numbers.length(-4.0, 4.0), numbers.length(-4.0, 4.0));
    match numbers.below(8) {
        0 => {
            let direction = DVec3::new(numbers.next(), numbers.next(), numbers.next());
            offset += direction * 10f64.powf(numbers.uniform(-12.0, -4.0));
        }
        1 => offset = DVec3::ZERO,
        _ => {}
    }
    solid.translate(offset)
}

/// Returns a part, one in three with a side in a plane of a side of `whole`, or almost in it.
fn next_part(whole: &Shape, numbers: &mut Numbers) -> Shape {
    let part = part(numbers);
    if numbers.below(3) != 0 {
        return part;
    }
    let axis = numbers.below(3) as usize;
    let (own, other) = (numbers.one_of(&whole.bounds()), numbers.one_of(&part.bounds()));
    let mut offset = DVec3::ZERO;
    offset[axis] = own[axis] - other[axis];
    if numbers.below(3) == 0 {
        offset[axis] += numbers.uniform(-1.0, 1.0) * 10f64.powf(numbers.uniform(-9.0, -2.0));
    }
    part.translate(offset)
}

/// Returns the number of operations of a chain that moved a solid, after 12 steps whose volumes add up.
fn moved_in_chain(seed: u64) -> usize {
    let mut numbers = Numbers(seed * 1_000_003);
    let mut whole = part(&mut numbers);
    let mut moved = 0;
    for step in 0..12 {
        let part = next_part(&whole, &mut numbers);
        let all = [SolidOperation::Union, SolidOperation::Intersection, SolidOperation::Difference];
        let results = all.map(|operation| {
            whole.combine(&part, operation).unwrap_or_else(|error| panic!("seed {seed}, {step}: {error}"))
        });
        let shift = results.iter().map(|result| result.shift).fold(0.0, f64::max);
        moved += results.iter().filter(|result| result.shift > 0.0).count();
        let [union, both, rest] =
            results.each_ref().map(|result| result.solid.as_ref().map_or(0.0, Shape::volume));
        let (one, two) = (whole.volume(), part.volume());
        let most = 1e-7 * one.max(two) + shift * part.area();
        let text = format!("seed {seed}, {step}: {one} and {two} m³ are {union}, {both} and {rest} m³");
        assert!((union + both - one - two).abs() <= most && (rest + both - one).abs() <= most, "{text}");
        let [union, both, rest] = results.map(|result| result.solid);
        let next = match numbers.below(5) {
            0 | 1 => union.clone(),
            2 | 3 => rest,
            _ => both,
        };
        whole = next.filter(|next| next.volume() > 0.5).or(union).unwrap();
    }
    moved
}

#[test]
fn volumes_of_union_intersection_and_difference_add_up_in_random_chains() {
    let moved: usize = (0..60).map(moved_in_chain).sum();
    assert!(moved == 0, "{moved} of {} operations moved a solid", 60 * 12 * 3);
}

#[test]
fn volumes_add_up_if_parts_of_a_result_touch_at_an_edge() {
    // A point of the difference was moved to another one, which added 4.5 dm³.
    assert!(moved_in_chain(1302) == 0);
    // All attempts gave a result with a fold that was repaired afterwards.
    assert!(moved_in_chain(31_396) == 0);
    // The difference only succeeds with a solid that is moved.
    assert!(moved_in_chain(756) <= 1);
}

#[test]
fn solids_that_overlap_by_less_than_rounding_errors_have_no_intersection() {
    assert!(moved_in_chain(11_005) == 0 && moved_in_chain(12_457) == 0);
}
