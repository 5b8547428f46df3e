//! Conversion of linear colour components to bytes of images.

use std::sync::LazyLock;

/// Number of equal parts of 0 to 1, in each of which at most one byte begins, except the first two.
const PARTS: u16 = 4096;

/// Bytes, and the numbers at which they begin.
struct SrgbBytes {
    /// Smallest number whose byte is the index, and infinity after the last.
    starts: [f32; 257],
    /// Byte of the number at the start of each part.
    parts: Vec<u8>,
}

static BYTES: LazyLock<SrgbBytes> = LazyLock::new(|| {
    let mut starts = [f32::INFINITY; 257];
    for (byte, start) in (0..=255).zip(&mut starts) {
        // Numbers of one sign are in the order of their bits.
        let (mut low, mut high) = (0, 1.0f32.to_bits());
        while low < high {
            let middle = low.midpoint(high);
            if byte_by_formula(f32::from_bits(middle)) < byte {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        *start = f32::from_bits(low);
    }
    let parts = (0..=PARTS).map(|part| byte_by_formula(f32::from(part) / f32::from(PARTS))).collect();
    SrgbBytes { starts, parts }
});

/// Converts a linear component, 0 to 1, to a byte of an sRGB image (IEC 61966-2-1).
#[inline]
pub fn srgb_byte(linear: f32) -> u8 {
    if linear >= 1.0 {
        return 255;
    }
    let bytes = &*BYTES;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a cast saturates, and NaN is 0"
    )]
    let part = (linear * f32::from(PARTS)) as usize;
    let mut byte = bytes.parts.get(part).copied().unwrap_or(255);
    while linear >= bytes.starts[usize::from(byte) + 1] {
        byte += 1;
    }
    byte
}

/// Converts a component by the transfer function.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a float to integer cast saturates"
)]
fn byte_by_formula(linear: f32) -> u8 {
    let curved = if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (curved * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_and_the_function_give_the_same_byte() {
        let step = f32::MIN_POSITIVE.to_bits() / 64;
        for number in (0..1.0f32.to_bits() / step).map(|at| f32::from_bits(at * step)) {
            assert_eq!(srgb_byte(number), byte_by_formula(number), "{number}");
        }
        for number in (0..=65_535_u16).map(|at| f32::from(at) / 65_535.0) {
            assert_eq!(srgb_byte(number), byte_by_formula(number), "{number}");
        }
    }

    #[test]
    fn numbers_outside_of_the_range_become_the_first_and_the_last_byte() {
        let numbers = [f32::NAN, f32::NEG_INFINITY, -1.0, -0.0, 0.0, 1.0, 7.0, f32::INFINITY];
        assert_eq!(numbers.map(srgb_byte), [0, 0, 0, 0, 0, 255, 255, 255]);
    }
}
