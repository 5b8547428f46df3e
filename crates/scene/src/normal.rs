//! Unit vectors in 32 bits.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3, Vec3A, Vec4};

/// Maximum value of an octahedral coordinate.
const MOST: f32 = i16::MAX as f32;

/// 1.5 x 2^23. Adding it to a number rounds the number to an integer, which the lowest bits of the sum contain. A
/// rounding instruction is not available on the oldest supported processors, so `round` would be a function call.
const ROUNDING: f32 = 12_582_912.0;

/// Unit vector with a precision of 0.005 degrees, in a third of the memory of three f32.
///
/// Directions are projected onto an octahedron, whose lower half is folded outwards into a square around the upper
/// half, as in Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", 2014. Directions
/// along the axes are exact.
///
/// ```
/// use burgeon_scene::Normal;
/// use glam::{DVec3, Vec3};
///
/// assert_eq!(Normal::from(DVec3::X).vector(), Vec3::X);
/// let slope = DVec3::new(1.0, 2.0, 3.0).normalize();
/// let angle = Normal::from(slope).vector().angle_between(slope.as_vec3());
/// assert!(angle <= 1e-3 && std::mem::size_of::<Normal>() == 4);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Normal([i16; 2]);

impl Normal {
    /// Upward direction.
    pub const Z: Self = Self([0, 0]);

    /// Maximum angle (radians) between the stored and the original vector.
    pub const PRECISION: f32 = 8.7e-5;

    /// Returns the vector, of length 1 up to rounding.
    #[inline]
    pub fn vector(self) -> Vec3 {
        let [x, y] = self.0.map(|coordinate| f32::from(coordinate) / MOST);
        let z = 1.0 - x.abs() - y.abs();
        let fold = (-z).max(0.0);
        let [x, y] = [x, y].map(|it| it - fold.copysign(it));
        Vec3::new(x, y, z).normalize()
    }

    /// Encodes the directions of four vectors of any length, given by their x, y and z coordinates; upwards for vectors
    /// without a direction.
    #[inline]
    pub fn four([x, y, z]: [Vec4; 3]) -> [Self; 4] {
        let sum = x.abs() + y.abs() + z.abs();
        // Both comparisons are false for NaN.
        let good = sum.cmpge(Vec4::splat(1e-30)) & sum.cmple(Vec4::splat(1e30));
        let part = sum.recip();
        let [x, y] = [x, y].map(|it| Vec4::select(good, it * part, Vec4::ZERO));
        let below = good & z.cmplt(Vec4::ZERO);
        let fold = |it: Vec4, other: Vec4| Vec4::select(below, (1.0 - other.abs()).copysign(it), it);
        let whole = |it: Vec4| (it * MOST + ROUNDING).to_array();
        let (x, y) = (whole(fold(x, y)), whole(fold(y, x)));
        [0, 1, 2, 3].map(|i| Self::from_sums([x[i], y[i]]))
    }

    /// Encodes the direction of a vector (x, y, z) of any length; upwards if it has none.
    #[inline]
    fn along([x, y, z]: [f32; 3]) -> Self {
        let sum = x.abs() + y.abs() + z.abs();
        // The range does not contain NaN.
        if !(1e-30..=1e30).contains(&sum) {
            return Self::Z;
        }
        let part = 1.0 / sum;
        let (x, y) = (x * part, y * part);
        let folded =
            if z < 0.0 { [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)] } else { [x, y] };
        Self::from_sums(folded.map(|it| it * MOST + ROUNDING))
    }

    /// Creates a normal from coordinates to which [`ROUNDING`] has been added.
    #[inline]
    #[allow(clippy::cast_possible_truncation, reason = "the lowest 16 bits are the integer")]
    fn from_sums(sums: [f32; 2]) -> Self {
        Self(sums.map(|sum| sum.to_bits() as i16))
    }
}

impl std::ops::Neg for Normal {
    type Output = Self;

    fn neg(self) -> Self {
        Self::from(-self.vector())
    }
}

impl From<Vec3> for Normal {
    #[inline]
    fn from(vector: Vec3) -> Self {
        Self::along(vector.to_array())
    }
}

impl From<Vec3A> for Normal {
    #[inline]
    fn from(vector: Vec3A) -> Self {
        Self::along(vector.to_array())
    }
}

impl From<DVec3> for Normal {
    #[inline]
    fn from(vector: DVec3) -> Self {
        Self::along(vector.as_vec3().to_array())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_axes_are_exact_and_what_has_no_direction_looks_up() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
            assert_eq!(Normal::from(axis * 3.0).vector(), axis);
            assert_eq!((-Normal::from(axis)).vector(), -axis);
        }
        for nowhere in [Vec3::ZERO, Vec3::NAN, Vec3::new(f32::INFINITY, 0.0, 0.0), Vec3::splat(1e-35)] {
            assert_eq!(Normal::from(nowhere), Normal::Z);
        }
    }

    proptest! {
        #[test]
        fn four_at_once_are_as_each_by_itself(vectors in prop::array::uniform4(prop::array::uniform3(
            prop_oneof![8 => -1.0f32..1.0, 1 => Just(0.0), 1 => Just(-0.0), 1 => Just(f32::NAN), 1 => Just(1e31)],
        ))) {
            let axes = [0, 1, 2].map(|axis| Vec4::from_array(vectors.map(|vector| vector[axis])));
            prop_assert_eq!(Normal::four(axes), vectors.map(|vector| Normal::from(Vec3::from_array(vector))));
        }

        #[test]
        fn every_direction_is_kept(x in -1.0f64..1.0, y in -1.0f64..1.0, z in -1.0f64..1.0, size in 1e-20f64..1e20) {
            let vector = DVec3::new(x, y, z);
            prop_assume!(vector.length() > 1e-3);
            let kept = Normal::from(vector * size).vector();
            prop_assert!((kept.length() - 1.0).abs() < 1e-6);
            prop_assert!(kept.as_dvec3().angle_between(vector) < f64::from(Normal::PRECISION));
        }
    }
}
