//! Equal-area projection of a square to a part of a sphere.
//!
//! Method: Roşca and Plonka, "Uniform spherical grids via equal area projection from the cube to the sphere",
//! 2011: a square is mapped to a curved square in the plane, and that to a sixth of the sphere by Lambert's
//! projection.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

use glam::{DVec2, DVec3};

use super::faces::{CubeFace, FACES};

/// Returns the direction (a unit vector) of a position on a face, from -1 to 1 to the east and to the north.
pub(super) fn direction(face: usize, place: DVec2) -> DVec3 {
    let [east, north, out] = axes(&FACES[face]);
    let curved = if place.y.abs() <= place.x.abs() {
        curve(place.x, place.y)
    } else {
        let turned = curve(place.y, place.x);
        DVec2::new(turned.y, turned.x)
    };
    let square = curved.length_squared();
    let flat = curved * (1.0 - square / 4.0).max(0.0).sqrt();
    east * flat.x + north * flat.y + out * (1.0 - square / 2.0)
}

/// Returns the face that a direction passes through, and the position on it, from -1 to 1 to the east and to
/// the north.
pub(super) fn place(direction: DVec3) -> (usize, DVec2) {
    let along = direction.normalize_or(DVec3::X);
    let height = |face: &CubeFace| axes(face)[2].dot(along);
    let face = (1..FACES.len())
        .fold(0, |best, face| if height(&FACES[face]) > height(&FACES[best]) { face } else { best });
    let [east, north, out] = axes(&FACES[face]);
    let flat = DVec2::new(east.dot(along), north.dot(along));
    let curved = flat * (2.0 / (1.0 + out.dot(along))).sqrt();
    let square = if curved.y.abs() <= curved.x.abs() {
        straighten(curved.x, curved.y)
    } else {
        let turned = straighten(curved.y, curved.x);
        DVec2::new(turned.y, turned.x)
    };
    (face, square.clamp(DVec2::NEG_ONE, DVec2::ONE))
}

/// Returns the side length of a square with the area of a face of a sphere with this radius.
pub(super) fn side(radius: f64) -> f64 {
    radius * (PI * 2.0 / 3.0).sqrt()
}

/// Returns the position in the curved square; the absolute value of `along` is at least that of `across`.
fn curve(along: f64, across: f64) -> DVec2 {
    if along == 0.0 {
        return DVec2::ZERO;
    }
    let (sine, cosine) = (across * PI / (12.0 * along)).sin_cos();
    DVec2::new(SQRT_2 * cosine - 1.0, SQRT_2 * sine) * (along * SQRT_2.sqrt() / (SQRT_2 - cosine).sqrt())
}

/// Computes the inverse of [`curve`].
fn straighten(along: f64, across: f64) -> DVec2 {
    if along == 0.0 {
        return DVec2::ZERO;
    }
    // From tan(angle) = sqrt2 sin(turn) / (sqrt2 cos(turn) - 1).
    let angle = (across / along).atan();
    let turn = angle - (angle.sin() / SQRT_2).asin();
    let cosine = turn.cos();
    let square = (along * along + across * across) / SQRT_2;
    let length = (square * (SQRT_2 - cosine) / (3.0 - 2.0 * SQRT_2 * cosine)).sqrt();
    DVec2::new(1.0, turn * 12.0 / PI) * length.copysign(along)
}

fn axes(face: &CubeFace) -> [DVec3; 3] {
    face.axes.map(|axis| DVec3::from(axis.map(f64::from)))
}

/// Returns the area on a unit sphere between directions, counter-clockwise.
///
/// Method: Van Oosterom and Strackee, "The solid angle of a plane triangle", 1983.
#[cfg(test)]
pub(super) fn area(corners: &[DVec3]) -> f64 {
    let first = corners[0];
    corners[1..]
        .windows(2)
        .map(|pair| {
            let (a, b) = (pair[0], pair[1]);
            2.0 * first.dot(a.cross(b)).atan2(1.0 + first.dot(a) + a.dot(b) + b.dot(first))
        })
        .sum()
}

/// Returns the absolute latitude (degrees) of a direction relative to the equator of `axis`.
///
/// ```
/// use burgeon_terrain::globe::latitude;
/// use glam::DVec3;
///
/// assert!((latitude(DVec3::new(1.0, 0.0, 1.0), DVec3::Z) - 45.0).abs() < 1e-9);
/// assert!((latitude(DVec3::NEG_Z, DVec3::Z) - 90.0).abs() < 1e-9);
/// ```
pub fn latitude(direction: DVec3, axis: DVec3) -> f64 {
    (FRAC_PI_2 - direction.angle_between(axis)).abs().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_base::random::Stream;

    #[test]
    fn a_place_has_the_direction_that_has_the_place() {
        let mut stream = Stream::new(3);
        for round in 0..60_000 {
            let at = DVec2::new(stream.uniform(), stream.uniform()) * 2.0 - 1.0;
            let way = direction(round % 6, at);
            assert!((way.length() - 1.0).abs() < 1e-14);
            let (face, back) = place(way * 100.0);
            assert!(face == round % 6 && (back - at).length() < 1e-12, "{round}: {at} {back}");
        }
    }

    #[test]
    fn cells_have_equal_areas() {
        let across = 8;
        for cell in 0..across * across {
            let begin = DVec2::new(f64::from(cell % across), f64::from(cell / across));
            let at =
                |x: f64, y: f64| direction(0, (begin + DVec2::new(x, y)) * 2.0 / f64::from(across) - 1.0);
            // The sides are curves, approximated by `fine` straight segments.
            let measured = |fine: u32| {
                let side = |of: &dyn Fn(f64) -> DVec3| -> Vec<DVec3> {
                    (0..fine).map(|step| of(f64::from(step) / f64::from(fine))).collect()
                };
                let rim = [
                    side(&|t| at(t, 0.0)),
                    side(&|t| at(1.0, t)),
                    side(&|t| at(1.0 - t, 1.0)),
                    side(&|t| at(0.0, 1.0 - t)),
                ];
                // The centre comes first, as the apex of all triangles.
                let mut corners = vec![at(0.5, 0.5)];
                corners.extend(rim.concat());
                corners.push(corners[1]);
                area(&corners)
            };
            // Twice as many segments have a quarter of the error (Richardson extrapolation).
            let whole = (4.0 * measured(512) - measured(256)) / 3.0 * f64::from(across * across) * 6.0;
            assert!((whole / (4.0 * PI) - 1.0).abs() < 1e-9, "{cell}: {whole}");
        }
    }
}
