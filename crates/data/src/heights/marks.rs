//! Numbers that files of heights hold where a height is missing.

/// Numbers that programs write where a height is missing.
pub(crate) const MARKS: [f32; 7] = [-9999.0, -32768.0, -32767.0, 32767.0, -99999.0, 65535.0, 99999.0];

/// Returns true for a negative number that is written where a height is missing: no scale makes a height of it.
#[cfg(feature = "data")]
pub(crate) fn is_negative_mark(sample: f64) -> bool {
    MARKS.iter().any(|mark| *mark < 0.0 && f64::from(*mark).to_bits() == sample.to_bits())
}
