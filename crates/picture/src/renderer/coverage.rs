//! Samples of the image and of the maps that a surface covers if it is translucent or cut out by its texture.

use super::stage::{DrawCall, ProjectedTriangle};
use super::texture::SampledTexture;
use glam::{Vec2, Vec3, Vec3A};

/// Alpha cutoff: texels below this opacity are holes in an otherwise opaque surface, as in glTF.
const CUT: f32 = 0.5;

/// Coverage of samples by a surface: the opacity is the fraction of covered samples, and each surface covers different
/// ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coverage<'a> {
    opacity: f32,
    seed: u32,
    /// Columns and rows of samples in a block. Every block has the same number of covered samples, plus or minus one.
    block: [usize; 2],
    cutout: Option<Cutout<'a>>,
}

/// Texture mapping of a triangle whose texture has holes.
#[derive(Debug, Clone, Copy)]
struct Cutout<'a> {
    texture: &'a SampledTexture,
    /// Level of the texture whose pixels are about as large as samples.
    level: usize,
    /// Texture coordinates (m) and 1, each divided by the distance from the camera, at the sample coordinates (0, 0).
    start: Vec3,
    /// Increment for each sample to the right, and for each sample downwards.
    growth: [Vec3; 2],
}

impl<'a> Coverage<'a> {
    /// Returns the coverage of a triangle of `draw`, in blocks with this number of columns and rows of samples.
    ///
    /// The corners of the `triangle` are in samples. With `perspective`, the third coordinate is 1 at infinity.
    #[inline]
    pub(super) fn of(
        draw: &DrawCall<'a>,
        triangle: &ProjectedTriangle,
        block: [usize; 2],
        perspective: bool,
    ) -> Self {
        let cutout = draw.cutout.and_then(|texture| {
            let corners = draw.triangles.get((triangle.number - draw.first) as usize)?;
            let uvs = corners.map(|corner| draw.part.uvs.get(corner as usize).copied().unwrap_or_default());
            let mix = |weights: Vec3A| uvs[0] * weights.x + uvs[1] * weights.y + uvs[2] * weights.z;
            let uvs = triangle.weights.map_or(uvs, |weights| weights.map(mix));
            Some(Cutout::new(texture, uvs, &triangle.corners, perspective))
        });
        Self { opacity: draw.opacity, seed: draw.first.wrapping_mul(0x9e37_79b9), block, cutout }
    }

    /// Returns true if the surface covers all samples.
    pub(super) fn is_full(&self) -> bool {
        self.opacity >= 1.0 && self.cutout.is_none()
    }

    /// Returns true if the surface covers sample `x`, `y`, which is offset by `shift` (1/256 sample) to the right of
    /// `x`.
    #[inline]
    pub(super) fn covers(&self, x: usize, y: usize, shift: f64) -> bool {
        let Some(cutout) = &self.cutout else {
            return self.opacity >= 1.0 || self.threshold(x, y) < self.opacity;
        };
        let alpha = cutout.alpha(x as f32 + shift as f32 / 256.0, y as f32 + 0.5);
        if self.opacity >= 1.0 && cutout.level == 0 {
            return alpha >= CUT;
        }
        // At a distance, a sample covers holes together with their surroundings.
        self.threshold(x, y) < self.opacity * alpha
    }

    fn threshold(&self, x: usize, y: usize) -> f32 {
        let [columns, rows] = self.block;
        let count = columns * rows;
        let place = y % rows * columns + x % columns;
        // An odd step visits all numbers of a power of two. Surfaces use different steps, so that their patterns
        // differ.
        let step = 2 * (self.seed as usize >> 16) + 5;
        let turn = place.wrapping_mul(step) % count;
        let start = noise((x / columns) as u32, (y / rows) as u32, self.seed);
        (turn as f32 / count as f32 + start).fract()
    }
}

impl<'a> Cutout<'a> {
    fn new(texture: &'a SampledTexture, uvs: [Vec2; 3], triangle: &[Vec3A; 3], perspective: bool) -> Self {
        let [a, b, c] = triangle.map(|corner| corner.truncate());
        let near = triangle.map(|corner| if perspective { 1.0 - corner.z } else { 1.0 });
        let [at, to_b, to_c] = [0, 1, 2].map(|i| uvs[i].extend(1.0) * near[i]);
        let (ab, ac) = (b - a, c - a);
        let area = ab.perp_dot(ac);
        // A triangle seen edge-on covers no sample.
        let part = if area == 0.0 { 0.0 } else { 1.0 / area };
        let right = ((to_b - at) * ac.y - (to_c - at) * ab.y) * part;
        let down = ((to_c - at) * ab.x - (to_b - at) * ac.x) * part;
        let middle = (a + b + c) / 3.0;
        let mut cutout =
            Self { texture, level: 0, start: at - right * a.x - down * a.y, growth: [right, down] };
        let here = cutout.uv(middle.x, middle.y);
        let beside = [cutout.uv(middle.x + 1.0, middle.y) - here, cutout.uv(middle.x, middle.y + 1.0) - here];
        cutout.level = texture.level_of(beside);
        cutout
    }

    fn uv(&self, x: f32, y: f32) -> Vec2 {
        let [right, down] = self.growth;
        let sum = self.start + right * x + down * y;
        sum.truncate() / sum.z
    }

    fn alpha(&self, x: f32, y: f32) -> f32 {
        self.texture.alpha(self.uv(x, y), self.level)
    }
}

/// Returns a pseudo-random number from 0 to 1.
pub(super) fn noise(x: u32, y: u32, seed: u32) -> f32 {
    let mut bits = x.wrapping_mul(0x8da6_b343) ^ y.wrapping_mul(0xd816_3841) ^ seed.wrapping_mul(0xcb1a_b31f);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    ((bits ^ (bits >> 16)) >> 8) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_covers_as_much_as_the_opacity_says() {
        let coverage = Coverage { opacity: 0.3, seed: 5, block: [4, 4], cutout: None };
        let covered = (0..10_000).filter(|i| coverage.covers(i % 100, i / 100, 128.0)).count();
        assert!((2850..3150).contains(&covered), "{covered} of 10000");
    }
}
