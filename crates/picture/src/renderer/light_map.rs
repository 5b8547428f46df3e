//! Projection of a depth map: parallel to the light and fitted to the model.

use glam::{Affine3A, Mat3A, Vec3A};

/// Parallel projection of the stage onto a grid of texels.
#[derive(Debug, Clone)]
pub(super) struct LightProjection {
    /// Transform from the stage to texels, to the right and downwards, and to the distance along the light, 0 or more.
    pub to_texels: Affine3A,
    /// Number of texels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Side of a texel, in the stage's units.
    pub texel: f32,
    /// Distance from the nearest to the farthest point, in the stage's units.
    pub depth: f32,
}

impl LightProjection {
    /// Fits a projection for light from `direction`, a unit vector, with about `side` times `side` texels.
    pub(super) fn fit(hull: &[Vec3A], direction: Vec3A, side: f32) -> Self {
        let upright = if direction.z.abs() > 0.99 { Vec3A::Y } else { Vec3A::Z };
        let right = upright.cross(direction).normalize();
        let up = direction.cross(right);
        let turn = Mat3A::from_cols(right, up, -direction).transpose();
        let (low, high) = hull
            .iter()
            .map(|point| turn * *point)
            .fold(None, |bounds: Option<(Vec3A, Vec3A)>, p| {
                Some(bounds.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
            })
            .unwrap_or_default();
        let pad = Vec3A::splat(0.005);
        let (low, high) = (low - pad, high + pad);
        let size = high - low;
        // A long narrow model gets a long narrow map with square texels.
        let texel = ((size.x * size.y).sqrt() / side).max(size.x.max(size.y) / (8.0 * side));
        let count = |length: f32| (length / texel).ceil().max(1.0) as usize;
        let scale = Mat3A::from_diagonal(glam::Vec3::new(1.0 / texel, 1.0 / texel, 1.0));
        let matrix3 = scale * turn;
        Self {
            to_texels: Affine3A { matrix3, translation: -(scale * low) },
            width: count(size.x),
            height: count(size.y),
            texel,
            depth: size.z,
        }
    }

    /// Returns the number of texels.
    pub(super) fn texels(&self) -> usize {
        self.width * self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_holds_the_hull() {
        let hull = [Vec3A::ZERO, Vec3A::new(1.0, 0.2, 0.3), Vec3A::new(-0.5, 0.1, 0.9)];
        for direction in [Vec3A::Z, Vec3A::new(0.6, 0.0, -0.8), Vec3A::Y] {
            let frame = LightProjection::fit(&hull, direction, 100.0);
            for point in hull {
                let at = frame.to_texels.transform_point3a(point);
                assert!(
                    at.x >= 0.0 && at.x < frame.width as f32 && at.y >= 0.0 && at.y < frame.height as f32
                );
                assert!(at.z >= 0.0 && at.z <= frame.depth);
                let toward = frame.to_texels.transform_point3a(point + direction * 0.1);
                assert!(
                    (at.z - toward.z - 0.1).abs() < 1e-5 && at.truncate().distance(toward.truncate()) < 1e-3
                );
            }
        }
    }
}
