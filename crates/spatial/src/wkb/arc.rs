//! Conversion of circular arcs to lines.
//!
//! Source: ISO/IEC 13249-3 (SQL/MM), circular strings: each arc is defined by its ends and a point between
//! them.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// Maximum distance (m) of a line from its arc.
pub const NEAR: f64 = 0.01;

/// Maximum number of pieces of half an arc: sufficient for a radius of 8,000 km.
const MOST: f64 = 65_536.0;

/// Adds the points of the arc from `from` via `by` to `to`, without the first, so that the lines between them
/// are at most `near` from the arc.
///
/// All three points are included. Heights are interpolated linearly between them. Fails if `room` does, which
/// is called with a number of points before they are created.
///
/// If both ends are equal, the arc is a circle, and `by` is opposite to them. Collinear points form a line.
pub fn add_arc<E>(
    points: &mut Vec<DVec3>,
    [from, by, to]: [DVec3; 3],
    near: f64,
    mut room: impl FnMut(usize) -> Result<(), E>,
) -> Result<(), E> {
    // Coordinates relative to the first point.
    let start = from.truncate();
    let [a, b] = [by, to].map(|point| point.truncate() - start);
    let is_circle = b == DVec2::ZERO;
    let twice = 2.0 * a.perp_dot(b);
    let centre = match is_circle {
        true => a / 2.0,
        false => (a * b.length_squared() - b * a.length_squared()).perp() / twice,
    };
    let radius = centre.length();
    if !radius.is_finite() || radius <= near {
        room(2)?;
        points.extend([by, to]);
        return Ok(());
    }
    // The arc turns left if the middle point lies to the right of the line between the ends.
    let side = if is_circle || twice > 0.0 { 1.0 } else { -1.0 };
    // A chord over an angle is radius * (1 - cos(angle / 2)) from its arc; for a large radius that cosine
    // would be 1.
    let piece = 4.0 * (near / (2.0 * radius)).sqrt().asin();
    // The central angle is twice the inscribed angle, which is more accurate than a difference of directions
    // from afar.
    let seen = |one: DVec2, two: DVec2| match is_circle {
        true => PI,
        false => 2.0 * one.perp_dot(two).abs().atan2(one.dot(two)),
    };
    for (begin, turn, [one, two]) in [(DVec2::ZERO, seen(-b, a - b), [from, by]), (a, seen(a, b), [by, to])] {
        let count = (turn / piece).ceil().clamp(1.0, MOST);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        let pieces = count as u32;
        room(pieces as usize)?;
        let first = (begin - centre).to_angle();
        for step in 1..pieces {
            let part = f64::from(step) / count;
            let at = start + centre + DVec2::from_angle(first + side * turn * part) * radius;
            points.push(at.extend(one.z + (two.z - one.z) * part));
        }
        points.push(two);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(places: [[f64; 3]; 3]) -> Vec<DVec3> {
        let places = places.map(DVec3::from);
        let mut points = vec![places[0]];
        add_arc(&mut points, places, NEAR, |_| Ok::<(), ()>(())).unwrap();
        points
    }

    #[test]
    fn lines_are_within_a_centimetre_of_the_arc_and_pass_through_what_was_given() {
        let mut cases = 0;
        for radius in [0.02, 0.5, 3.0, 40.0, 1e3, 1e6] {
            for (begin, half) in [(0.0, 0.3), (1.0, 1.5), (-2.0, 3.0), (3.0, -0.2), (0.5, -3.1), (2.0, 1e-3)]
            {
                let (cx, cy) = (6.6e5, -2.5e6);
                let at = |angle: f64, z: f64| [cx + radius * angle.cos(), cy + radius * angle.sin(), z];
                let given = [at(begin, 0.0), at(begin + half, 4.0), at(begin + 2.0 * half, 6.0)];
                let points = arc(given);
                assert!(given.iter().all(|point| points.contains(&DVec3::from(*point))));
                let mut length = 0.0;
                for pair in points.windows(2) {
                    let middle = [(pair[0][0] + pair[1][0]) / 2.0, (pair[0][1] + pair[1][1]) / 2.0];
                    let off = (middle[0] - cx).hypot(middle[1] - cy) - radius;
                    assert!(off.abs() < NEAR * 1.01, "{radius} {begin} {half}: {off}");
                    length += (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
                    assert!(pair[1][2] >= pair[0][2]);
                }
                let whole = radius * 2.0 * half.abs();
                assert!((length - whole).abs() < 0.05 * whole + 0.02, "{radius} {half}: {length} {whole}");
                cases += 1;
            }
        }
        assert_eq!(cases, 36);
    }

    #[test]
    fn a_circle_and_a_straight_line_are_what_they_are() {
        let circle = arc([[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]]);
        let area: f64 =
            circle.windows(2).map(|it| it[0][0] * it[1][1] - it[0][1] * it[1][0]).sum::<f64>() / 2.0;
        assert!((area - std::f64::consts::PI).abs() < 0.05, "{area}");
        let line = [[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 2.0]];
        assert_eq!(arc(line), line.map(DVec3::from));
        for odd in [[f64::NAN; 3], [f64::INFINITY; 3], [1e300; 3], [0.0; 3]] {
            assert!(arc([[0.0; 3], odd, [1.0, 0.0, 0.0]]).len() < 10);
        }
    }

    #[test]
    fn arcs_that_are_nearly_straight_have_no_more_points_than_a_centimetre_takes() {
        // A millimetre off a line of 2,000 km, and less than the rounding error.
        for off in [1e-3, 1e-9, 1e-300] {
            let given = [[0.0; 3], [1e6, off, 0.0], [2e6, 0.0, 0.0]];
            assert_eq!(arc(given), given.map(DVec3::from));
            let far = given.map(|[x, y, z]| [x + 0.1, y - 1e6, z]);
            assert_eq!(arc(far).len(), 3);
        }
        // 0.8 m off: each half is a quarter of that from its chord, so five pieces of less than a centimetre
        // each.
        assert_eq!(arc([[0.0; 3], [1e6, 0.8, 0.0], [2e6, 0.0, 0.0]]).len(), 1 + 2 * 5);
    }

    #[test]
    fn room_is_asked_for_before_there_are_points() {
        let mut points = Vec::new();
        let places = [[0.0; 3], [2e6, 0.0, 0.0], [0.0; 3]].map(DVec3::from);
        let asked = add_arc(&mut points, places, NEAR, Err);
        assert!(asked.unwrap_err() > 10_000 && points.is_empty());
    }
}
