//! Frames along a curve that rotate as little as possible about its tangent.

use glam::DVec3;

/// Returns a direction perpendicular to the tangent at each of `points` (m), beginning with that closest to `first`,
/// such that the frames do not rotate about the tangents.
///
/// `tangents` are unit vectors, one for each point. Method: double reflection, Wang, Jüttler, Zheng, Liu, "Computation
/// of rotation minimizing frames", 2008; the error falls with the fourth power of the step.
///
/// ```
/// use burgeon_geometry::rotation_minimizing;
/// use glam::DVec3;
///
/// let turn = rotation_minimizing(&[DVec3::ZERO, DVec3::ONE], &[DVec3::X, DVec3::Y], DVec3::Z);
/// assert!(turn[1].dot(DVec3::Y).abs() < 1e-12 && (turn[1].length() - 1.0).abs() < 1e-12);
/// ```
pub fn rotation_minimizing(points: &[DVec3], tangents: &[DVec3], first: DVec3) -> Vec<DVec3> {
    let mut all: Vec<DVec3> = Vec::with_capacity(points.len());
    for (index, (at, tangent)) in points.iter().zip(tangents).enumerate() {
        let side = match all.last() {
            None => first,
            Some(side) => {
                let step = *at - points[index - 1];
                let [side, before] = [*side, tangents[index - 1]].map(|it| reflect(it, step));
                reflect(side, *tangent - before)
            }
        };
        // Removes rounding errors, and makes the first direction perpendicular.
        let side = side.reject_from_normalized(*tangent);
        let sound = side.length_squared() > 1e-12 && side.is_finite();
        all.push(if sound { side.normalize() } else { tangent.any_orthonormal_vector() });
    }
    all
}

/// Returns `vector` reflected in the plane perpendicular to `normal`; unchanged if `normal` is zero.
fn reflect(vector: DVec3, normal: DVec3) -> DVec3 {
    let square = normal.length_squared();
    if square > 1e-30 { vector - normal * (2.0 * normal.dot(vector) / square) } else { vector }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn around_a_circle_the_normal_of_its_plane_stays() {
        let angle = |i: usize| i as f64 * 0.2;
        let points: Vec<DVec3> = (0..40).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect();
        let tangents: Vec<DVec3> =
            (0..40).map(|i| DVec3::new(-angle(i).sin(), angle(i).cos(), 0.0)).collect();
        let sides = rotation_minimizing(&points, &tangents, DVec3::Z);
        assert!(sides.iter().all(|side| side.distance(DVec3::Z) < 1e-12));
        let radial = rotation_minimizing(&points, &tangents, DVec3::X);
        assert!(radial.iter().zip(&points).all(|(side, at)| side.distance(*at) < 1e-12));
    }

    #[test]
    fn on_a_helix_the_frame_turns_back_by_the_torsion() {
        // Radius 1, rise 1 per radian: the torsion is 1/2 per metre, and the length sqrt(2) per radian.
        for (steps, slack) in [(32, 1e-3), (64, 1e-4), (128, 1e-5)] {
            let angle = |i: usize| i as f64 * 6.0 / steps as f64;
            let points: Vec<DVec3> =
                (0..=steps).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), angle(i))).collect();
            let tangents: Vec<DVec3> =
                (0..=steps).map(|i| DVec3::new(-angle(i).sin(), angle(i).cos(), 1.0) / 2f64.sqrt()).collect();
            let inward = |i: usize| -DVec3::new(angle(i).cos(), angle(i).sin(), 0.0);
            let sides = rotation_minimizing(&points, &tangents, inward(0));
            let binormal = tangents[steps].cross(inward(steps));
            let turned = sides[steps].dot(binormal).atan2(sides[steps].dot(inward(steps)));
            let expected = -0.5 * 2f64.sqrt() * 6.0;
            let error = (turned - expected).rem_euclid(std::f64::consts::TAU);
            let error = error.min(std::f64::consts::TAU - error);
            assert!(error < slack, "{steps}: {error}");
        }
    }
}
