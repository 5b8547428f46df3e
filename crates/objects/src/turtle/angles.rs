//! Sines and cosines of angles that repeat.

/// The sines and cosines of recent angles: most systems repeat the same few angles.
#[derive(Clone, Default)]
pub(super) struct Angles {
    /// Bits of an angle (degrees), its sine and its cosine, at an index hashed from the bits.
    known: [(u64, f64, f64); 16],
}

impl Angles {
    /// Returns the sine and cosine of `angle` (degrees).
    #[inline]
    pub(super) fn sin_cos(&mut self, angle: f64) -> (f64, f64) {
        // Adds 1 because an empty entry has the bits of 0.
        let bits = angle.to_bits().wrapping_add(1);
        let place = bits.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 60;
        let known = &mut self.known[place as usize];
        if known.0 != bits {
            let (sin, cos) = angle.to_radians().sin_cos();
            *known = (bits, sin, cos);
        }
        (known.1, known.2)
    }
}
