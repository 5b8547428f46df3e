//! Vectors and texture coordinates as glTF stores them.

use super::quantize::round_to_step;
use burgeon_scene::Normal;
use glam::Vec3;

/// Converts a vector of the scene, z up, to glTF's coordinates, y up. Adding zero turns -0 into 0.
pub(super) fn y_up(vector: Vec3) -> Vec3 {
    Vec3::new(vector.x, vector.z, -vector.y) + 0.0
}

/// Returns the nearest integer. `round` is a library call on the baseline processor and therefore slower.
#[allow(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn nearest(number: f32) -> i32 {
    (number + 0.5f32.copysign(number)) as i32
}

/// Converts a unit vector to multiples of 1/127, followed by a zero.
#[allow(clippy::cast_possible_truncation, reason = "bounded before")]
pub(super) fn byte_normal(normal: Normal) -> [i8; 4] {
    let [x, y, z] = y_up(normal.vector()).to_array().map(|it| nearest(it * 127.0));
    [x as i8, y as i8, z as i8, 0]
}

/// Converts a unit vector to multiples of 1/32767, followed by a zero.
pub(super) fn short_normal(normal: Normal) -> [i16; 4] {
    let [x, y, z] = y_up(normal.vector()).to_array().map(short);
    [x, y, z, 0]
}

/// Converts a number from -1 to 1 to a multiple of 1/32767.
#[allow(clippy::cast_possible_truncation, reason = "bounded before")]
pub(super) fn short(number: f32) -> i16 {
    nearest(number * 32767.0) as i16
}

/// Converts texture coordinates in metres, v upwards, to fractions of the image, v downwards.
pub(super) fn tex_coord(uv: glam::Vec2, size: [f64; 2]) -> [f32; 2] {
    [(f64::from(uv.x) / size[0]) as f32, (1.0 - f64::from(uv.y) / size[1]) as f32]
}

/// Mapping from texture coordinates of a part to those in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TexCoordMap {
    /// Width and height of the texture (m).
    pub(super) size: [f64; 2],
    /// Range of the material, if the file contains fractions of it.
    pub(super) range: Option<TexCoordRange>,
    /// Set if the fractions are multiples of 1/65535.
    pub(super) is_rounded: bool,
}

/// Range of the texture coordinates of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TexCoordRange {
    /// Smallest coordinates.
    pub(super) offset: [f32; 2],
    /// Difference between the largest and the smallest coordinates; above zero.
    pub(super) scale: [f32; 2],
}

impl TexCoordMap {
    /// Returns the map of a texture with this width and height (m), with exact coordinates.
    pub(super) fn exact(size: [f64; 2]) -> Self {
        Self { size, range: None, is_rounded: false }
    }

    /// Converts texture coordinates of a part (m).
    #[inline]
    pub(super) fn of(&self, uv: glam::Vec2) -> [f32; 2] {
        let exact = tex_coord(uv, self.size);
        let fraction = self.range.map_or(exact, |range| range.fraction(exact));
        if self.is_rounded { fraction.map(round_to_step) } else { fraction }
    }
}

impl TexCoordRange {
    /// Returns the range between the smallest and the largest coordinates; `None` if it exceeds `most`. Coordinates within the
    /// image have the range of the image.
    pub(super) fn of([low, high]: [[f32; 2]; 2], most: f64) -> Option<Self> {
        if low.iter().all(|it| *it >= 0.0) && high.iter().all(|it| *it <= 1.0) {
            return Some(Self { offset: [0.0; 2], scale: [1.0; 2] });
        }
        let scale = [high[0] - low[0], high[1] - low[1]];
        let is_small = scale.iter().all(|it| f64::from(*it) <= most);
        let above_zero = |size: f32| if size > 0.0 { size } else { 1.0 };
        is_small.then(|| Self { offset: low, scale: scale.map(above_zero) })
    }

    /// Returns true if the range is that of the image.
    pub(super) fn is_identity(&self) -> bool {
        self.offset == [0.0; 2] && self.scale == [1.0; 2]
    }

    /// Returns coordinates as fractions of the range.
    pub(super) fn fraction(&self, uv: [f32; 2]) -> [f32; 2] {
        let part = |axis: usize| {
            ((f64::from(uv[axis]) - f64::from(self.offset[axis])) / f64::from(self.scale[axis])) as f32
        };
        [part(0), part(1)]
    }
}
