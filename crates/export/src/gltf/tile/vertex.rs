//! Vertices as they are stored.

use glam::{DVec3, Vec3};

use super::options::{TileCompression, TileModelOptions};

/// Largest u16 of a coordinate.
const MOST: f64 = 65_535.0;

/// Storage of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PlaceFormat {
    /// Single precision.
    Exact,
    /// Multiples of a step (m) in single precision.
    Rounded(f64),
    /// Integers: multiples of a step (m), a power of two, from an origin (m) on.
    Short { origin: DVec3, step: f64 },
}

/// Storage of vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct VertexFormat {
    pub(super) places: PlaceFormat,
    /// Set if normals are multiples of 1/127.
    pub(super) byte_normals: bool,
}

/// Vertex as it is stored. Equal vertices are stored once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct VertexRecord {
    /// Bits of single-precision numbers, or integers.
    pub(super) place: [u32; 3],
    /// Bits of single-precision numbers, or signed bytes in the lowest bits.
    pub(super) normal: [u32; 3],
    pub(super) tex_coord: [u32; 2],
    pub(super) feature: u32,
}

impl VertexFormat {
    /// Chooses the format of a mesh with a bounding box (m), y up.
    pub(super) fn of(options: &TileModelOptions, low: DVec3, high: DVec3) -> Self {
        if options.compression == TileCompression::None {
            return Self { places: PlaceFormat::Exact, byte_normals: false };
        }
        // A power of two, so that products with it are exact.
        let step = options.precision.max(1e-6).log2().floor().exp2();
        let origin = (low / step).floor() * step;
        let fits = (high - low).max_element() <= (MOST - 1.0) * step;
        let places = match fits && origin.as_vec3().as_dvec3() == origin {
            true => PlaceFormat::Short { origin, step },
            false => PlaceFormat::Rounded(step),
        };
        Self { places, byte_normals: true }
    }

    /// Returns the stored coordinates of a point (m), y up.
    pub(super) fn place(&self, point: DVec3) -> [u32; 3] {
        match self.places {
            PlaceFormat::Exact => float_bits(point.as_vec3()),
            PlaceFormat::Rounded(step) => float_bits(((point / step).round() * step).as_vec3()),
            PlaceFormat::Short { origin, step } => {
                #[allow(clippy::cast_sign_loss, reason = "bounded before")]
                let number = |value: f64| value.round().clamp(0.0, MOST) as u32;
                ((point - origin) / step).to_array().map(number)
            }
        }
    }

    /// Returns the stored form of a unit vector, y up.
    pub(super) fn normal(&self, normal: Vec3) -> [u32; 3] {
        if !self.byte_normals {
            return float_bits(normal);
        }
        let byte = |value: f32| u32::from(((value * 127.0).round() as i8).cast_unsigned());
        normal.to_array().map(byte)
    }

    /// Returns the bytes of stored coordinates.
    pub(super) fn put_place(&self, place: [u32; 3], out: &mut Vec<u8>) {
        match self.places {
            PlaceFormat::Short { .. } => {
                place.iter().for_each(|number| out.extend((*number as u16).to_le_bytes()));
                out.extend([0, 0]);
            }
            _ => place.iter().for_each(|bits| out.extend(bits.to_le_bytes())),
        }
    }

    /// Returns the bytes of a stored normal.
    pub(super) fn put_normal(&self, normal: [u32; 3], out: &mut Vec<u8>) {
        match self.byte_normals {
            true => {
                out.extend(normal.map(|byte| byte as u8));
                out.push(0);
            }
            false => normal.iter().for_each(|bits| out.extend(bits.to_le_bytes())),
        }
    }
}

/// Returns the bits of a vector in which both zeros are the same.
fn float_bits(vector: Vec3) -> [u32; 3] {
    (vector + 0.0).to_array().map(f32::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_stored_point_is_off_by_half_a_step_at_most(
            low in prop::array::uniform3(-4000.0..4000.0_f64), size in 0.001..8000.0_f64,
            part in prop::array::uniform3(0.0..1.0_f64), precision in 0.0005..0.2_f64,
        ) {
            let (low, compression) = (DVec3::from(low), TileCompression::Quantize);
            let options = TileModelOptions { compression, precision, ..TileModelOptions::default() };
            let format = VertexFormat::of(&options, low, low + size);
            let point = low + DVec3::from(part) * size;
            let stored = format.place(point);
            let read = match format.places {
                PlaceFormat::Short { origin, step } => {
                    prop_assert!(stored.iter().all(|number| *number <= 65_535) && step <= precision);
                    origin + DVec3::from(stored.map(f64::from)) * step
                }
                _ => Vec3::from(stored.map(f32::from_bits)).as_dvec3(),
            };
            prop_assert!((read - point).abs().max_element() <= precision / 2.0 + 5e-4, "{read} {point}");
            let (is_short, least) = (matches!(format.places, PlaceFormat::Short { .. }), precision / 2.0);
            prop_assert!(is_short || size > 65_533.0 * least || precision < 0.001);
            prop_assert!(!is_short || size < 65_536.0 * precision);
        }
    }
}
