//! Nearest points of triangles.

use glam::DVec3;

/// Returns the point of a triangle nearest to `place` (m).
///
/// Method: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: by the regions around the corners, edges and
/// face.
pub fn nearest_on_triangle(place: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, place - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = place - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = place - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let scale = 1.0 / (va + vb + vc);
    a + ab * (vb * scale) + ac * (vc * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_lies_on_the_face_an_edge_or_a_corner() {
        let (a, b, c) = (DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0);
        for (place, expected) in [
            (DVec3::new(0.5, 0.5, 3.0), DVec3::new(0.5, 0.5, 0.0)),
            (DVec3::new(1.0, -2.0, 0.0), DVec3::new(1.0, 0.0, 0.0)),
            (DVec3::new(-1.0, -1.0, 1.0), a),
            (DVec3::new(5.0, -1.0, 0.0), b),
            (DVec3::new(2.0, 2.0, 0.0), DVec3::new(1.0, 1.0, 0.0)),
            (DVec3::new(-1.0, 5.0, 0.0), c),
        ] {
            assert!((nearest_on_triangle(place, [a, b, c]) - expected).length() < 1e-12, "{place}");
        }
    }
}
