//! Deterministic smooth noise between -1 and 1.

use glam::{DVec2, DVec3};

/// Adds value noise with a feature size of 1 at `places`, enlarged by `scale` and multiplied by `strength`, to `sums`. Places in a row
/// from west to east are fast, because those in the same cell share its corners.
fn add_noise(places: &[DVec2], scale: f64, strength: f64, seed: u64, sums: &mut [f64]) {
    let mut first = 0;
    while let Some(&place) = places.get(first) {
        let begin = place * scale;
        let cell = DVec2::new(floor(begin.x), floor(begin.y));
        let at = |right: f64, down: f64| corner(cell.x + right, cell.y + down, seed);
        let [near_left, near_right, far_left, far_right] =
            [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
        let (near, far) = (near_right - near_left, far_right - far_left);
        let down = quintic(begin.y - cell.y);
        let is_beside = |other: &DVec2| {
            let x = other.x * scale;
            x >= cell.x && x < cell.x + 1.0 && other.y.to_bits() == place.y.to_bits()
        };
        let count = 1 + places[first + 1..].iter().take_while(|other| is_beside(other)).count();
        let row = first..first + count;
        for (place, sum) in places[row.clone()].iter().zip(&mut sums[row]) {
            let right = quintic(place.x * scale - cell.x);
            let (near, far) = (near_left + near * right, far_left + far * right);
            *sum += (near + (far - near) * down) * strength;
        }
        first += count;
    }
}

/// Returns the quintic interpolation between 0 and 1, which has continuous curvature at the borders of cells.
#[inline]
fn quintic(part: f64) -> f64 {
    part * part * part * (part * (part * 6.0 - 15.0) + 10.0)
}

/// Returns noise of `octaves` octaves, each half as large and half as strong as the previous one.
///
/// Method: value noise with quintic interpolation (K. Perlin, "Improving noise", 2002).
///
/// ```
/// use burgeon_terrain::octaves;
/// use glam::DVec2;
///
/// let at = |x: f64| octaves(DVec2::new(x, 7.3), 4, 5);
/// assert_eq!(at(0.25), at(0.25));
/// assert_ne!(at(0.25), octaves(DVec2::new(0.25, 7.3), 4, 6));
/// for step in 0..1000 {
///     let x = f64::from(step) * 0.01;
///     assert!(at(x).abs() <= 1.0 && (at(x) - at(x + 1e-6)).abs() < 1e-4);
/// }
/// ```
pub fn octaves(place: DVec2, octaves: u32, seed: u64) -> f64 {
    let mut noise = [0.0];
    octaves_along(&[place], octaves, seed, &mut noise);
    noise[0]
}

/// Writes the noise of [`octaves`] at each of `places` to `noise`, which has the same length. Places in a row from west to east take a
/// fraction of the time of single ones.
///
/// ```
/// use burgeon_terrain::{octaves, octaves_along};
/// use glam::DVec2;
///
/// let row: Vec<DVec2> = (0..100).map(|step| DVec2::new(f64::from(step) * 0.07, 7.3)).collect();
/// let mut noise = vec![0.0; row.len()];
/// octaves_along(&row, 4, 5, &mut noise);
/// assert!(row.iter().zip(&noise).all(|(place, noise)| octaves(*place, 4, 5) == *noise));
/// ```
pub fn octaves_along(places: &[DVec2], octaves: u32, seed: u64, noise: &mut [f64]) {
    noise.fill(0.0);
    let (mut whole, mut strength, mut scale) = (0.0, 1.0, 1.0);
    for octave in 0..octaves {
        add_noise(places, scale, strength, seed.wrapping_add(u64::from(octave)), noise);
        whole += strength;
        (strength, scale) = (strength * 0.5, scale * 2.03);
    }
    if whole > 0.0 {
        noise.iter_mut().for_each(|noise| *noise /= whole);
    }
}

/// Returns value noise at `place` in space, with a feature size of 1.
fn noise_around(place: DVec3, seed: u64) -> f64 {
    let cell = place.floor();
    let part = place - cell;
    let [right, down, up] = part.to_array().map(quintic);
    let level = |up: f64| {
        // Each level of corners has a different seed.
        let seed = seed ^ (cell.z + up + 0.0).to_bits().wrapping_mul(0xD6E8_FEB8_6659_FD93);
        let at = |right: f64, down: f64| corner(cell.x + right, cell.y + down, seed);
        let near = at(0.0, 0.0) + (at(1.0, 0.0) - at(0.0, 0.0)) * right;
        let far = at(0.0, 1.0) + (at(1.0, 1.0) - at(0.0, 1.0)) * right;
        near + (far - near) * down
    };
    let below = level(0.0);
    below + (level(1.0) - below) * up
}

/// Returns noise like [`octaves`] at a point in space, without the octaves that are smaller than `finest`.
///
/// ```
/// use burgeon_terrain::octaves_around;
/// use glam::DVec3;
///
/// let place = DVec3::new(0.3, 7.1, 2.8);
/// assert_eq!(octaves_around(place, 4, 5, 0.0), octaves_around(place, 4, 5, 0.01));
/// // With a finest detail of 0.3 only the octaves of size 1 and 1 / 2.03 are left.
/// assert_ne!(octaves_around(place, 4, 5, 0.3), octaves_around(place, 4, 5, 0.0));
/// ```
pub fn octaves_around(place: DVec3, octaves: u32, seed: u64, finest: f64) -> f64 {
    let (mut sum, mut whole, mut strength, mut scale) = (0.0, 0.0, 1.0, 1.0);
    for octave in 0..octaves {
        if scale * finest < 1.0 {
            sum += noise_around(place * scale, seed.wrapping_add(u64::from(octave))) * strength;
        }
        whole += strength;
        (strength, scale) = (strength * 0.5, scale * 2.03);
    }
    if whole > 0.0 { sum / whole } else { 0.0 }
}

/// Returns the greatest integer that is not above `number`, without the function call of [`f64::floor`] on processors without an
/// instruction for it.
#[inline]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "larger numbers are integers"
)]
fn floor(number: f64) -> f64 {
    if number.abs() >= 4_503_599_627_370_496.0 || number.is_nan() {
        return number;
    }
    let whole = number as i64 as f64;
    if whole > number { whole - 1.0 } else { whole }
}

/// Returns a pseudo-random number between -1 and 1 for a corner.
#[allow(clippy::cast_precision_loss, reason = "53 bits fit an f64 exactly")]
fn corner(x: f64, y: f64, seed: u64) -> f64 {
    let mut bits = x.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ y.to_bits().rotate_left(31) ^ seed;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((bits ^ (bits >> 31)) >> 11) as f64 / 4_503_599_627_370_496.0 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floor_is_that_of_the_standard_library() {
        let mut numbers =
            vec![0.0, 1.0, -1.0, 0.5, -0.5, -1e-300, 1e300, -1e300, 4_503_599_627_370_495.5, f64::INFINITY];
        numbers.extend((0..1000).map(|number| f64::from(number).powi(5) * -0.000_37 + 17.2));
        for number in numbers {
            assert!((floor(number) - number.floor()).abs() < 1e-300 || number.is_infinite(), "{number}");
        }
        assert!(floor(f64::NAN).is_nan());
    }

    #[test]
    fn noise_in_space_is_smooth_and_around_zero() {
        let (mut sum, mut most) = (0.0, 0.0f64);
        for step in 0..20_000 {
            let place = DVec3::new(0.37, -0.21, 0.11) * f64::from(step) * 0.01;
            let here = octaves_around(place, 4, 3, 0.0);
            let there = octaves_around(place + DVec3::splat(1e-4), 4, 3, 0.0);
            assert!(here.abs() <= 1.0 && (here - there).abs() < 0.01);
            sum += here;
            most = most.max((octaves_around(place, 4, 3, 0.3) - here).abs());
        }
        assert!((sum / 20_000.0).abs() < 0.1 && most > 0.0 && most < 0.5);
        assert!(octaves_around(DVec3::ONE * 0.3, 4, 3, 2.0).abs() < 1e-300);
    }
}
