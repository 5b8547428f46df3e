//! Numbers that mark missing heights in files.

/// Numbers that programs write for missing heights.
pub(crate) const MARKS: [f32; 7] = [-9999.0, -32768.0, -32767.0, 32767.0, -99999.0, 65535.0, 99999.0];

/// Returns true for a negative number that is used as a marker of missing heights; such a number must not be scaled.
pub(crate) fn is_negative_mark(sample: f64) -> bool {
    MARKS.iter().any(|mark| *mark < 0.0 && f64::from(*mark).to_bits() == sample.to_bits())
}
