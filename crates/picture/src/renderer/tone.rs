//! Tone mapping: converts light to display colours.

use glam::Vec3;
use std::sync::LazyLock;

/// Compresses light of any strength to 0 to 1, preserving the hue and saturation of colours that are not glaring.
///
/// Method: Khronos Group, "PBR Neutral Tone Mapper", 2024, with half of its contrast in the shadows, because the full
/// contrast makes dark colours too strong.
pub(super) fn compress(light: Vec3) -> Vec3 {
    const START: f32 = 0.8 - 0.02;
    const DESATURATION: f32 = 0.15;
    let light = light.max(Vec3::ZERO);
    let least = light.min_element();
    let offset = if least < 0.08 { 0.5 * least - 3.125 * least * least } else { 0.02 };
    let light = light - offset;
    let peak = light.max_element();
    if peak < START {
        return light;
    }
    let span = 1.0 - START;
    let compressed = 1.0 - span * span / (peak + span - START);
    let faded = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    (light * (compressed / peak)).lerp(Vec3::splat(compressed), faded)
}

/// Returns the linear value, 0 to 1, of an sRGB byte.
pub(super) fn decode(byte: u8) -> f32 {
    static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|byte| {
            let curved = byte as f32 / 255.0;
            if curved <= 0.040_45 { curved / 12.92 } else { ((curved + 0.055) / 1.055).powf(2.4) }
        })
    });
    LINEAR[usize::from(byte)]
}

#[cfg(test)]
mod tests {
    use burgeon_base::srgb_byte;

    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        let bytes = (0..=255_u8).filter(|byte| srgb_byte(decode(*byte)) == *byte).count();
        assert_eq!(bytes, 256);
    }

    #[test]
    fn more_light_is_never_darker_and_never_too_bright() {
        let mut last = 0.0;
        for i in 1..1000 {
            let now = compress(Vec3::splat(i as f32 * 0.02)).x;
            assert!(now > last && now <= 1.0, "{now} after {last}");
            last = now;
        }
    }
}
