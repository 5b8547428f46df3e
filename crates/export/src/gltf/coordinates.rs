//! Vectors and texture coordinates as glTF stores them.

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
