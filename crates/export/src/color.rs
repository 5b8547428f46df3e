//! Conversion of colour components.

/// Clamps `number` to 0 to 1; NaN becomes 0.
pub(super) fn fraction(number: f32) -> f32 {
    if number.is_nan() { 0.0 } else { number.clamp(0.0, 1.0) }
}

/// Converts a linear component, 0 to 1, to sRGB (IEC 61966-2-1).
pub(super) fn srgb(linear: f32) -> f32 {
    let linear = fraction(linear);
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Converts an sRGB component, 0 to 1, to linear.
pub(super) fn linear(srgb: f32) -> f32 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_none_becomes_zero() {
        assert_eq!([f32::NAN, -1.0, 0.25, f32::INFINITY].map(fraction).to_vec(), [0.0, 0.0, 0.25, 1.0]);
    }

    #[test]
    fn srgb_and_linear_undo_each_other() {
        for step in 0..=20_u8 {
            let value = f32::from(step) / 20.0;
            assert!((linear(srgb(value)) - value).abs() < 1e-5, "{value}");
        }
        assert!((srgb(0.5) - 0.735).abs() < 1e-3);
    }
}
