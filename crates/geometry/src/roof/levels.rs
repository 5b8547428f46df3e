//! Points at a level of a roof's faces.

use glam::DVec3;

/// Returns true if a point is exactly at a level (m).
#[allow(clippy::float_cmp, reason = "levels are copies")]
pub(super) fn is_at(point: DVec3, level: f64) -> bool {
    point.z == level
}

/// Interpolates between `low` and `high` at `level`, which is between their heights.
pub(super) fn at_level(low: DVec3, high: DVec3, level: f64) -> DVec3 {
    low.truncate().lerp(high.truncate(), (level - low.z) / (high.z - low.z)).extend(level)
}
