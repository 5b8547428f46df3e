//! Measured ground: heights between samples, to which rules add detail that vanishes at the samples.

use glam::DVec2;

/// Heights (m) from measurements or other sources.
pub trait HeightSource: Send + Sync {
    /// Returns the height (m) and the slope (m/m) of the ground at a point (m); `None` far outside. The
    /// height is exact at each sample, and interpolated smoothly or linearly between samples.
    fn ground(&self, place: DVec2, smooth: bool) -> Option<(f64, f64)>;

    /// Returns the strength (0 to 1) of added detail at a point (m): 0 at samples.
    fn freedom(&self, place: DVec2) -> f64;

    /// Returns the distance (m) of neighbouring samples, in the direction where they are closer.
    fn step(&self) -> f64;

    /// Returns the positions (m) of the samples in a box (m), row by row.
    fn samples(&self, low: DVec2, high: DVec2) -> Vec<DVec2>;
}
