//! Measured ground: heights between samples, to which rules add detail that vanishes at the samples.

use glam::DVec2;

use super::world::World;

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

/// Minimum slope (m/m) for the full addition of detail to measured heights.
const STEEP: f64 = 0.3;

impl World {
    /// Returns the height (m) of the ground at `place` (m), where the surface of the rules has the height
    /// `laid` (m): that height, or the measured height with as much detail as is allowed there.
    pub(super) fn ground(&self, place: DVec2, laid: f64) -> f64 {
        let Some(measured) = &self.measured else { return laid };
        let (height, slope) = measured.ground(place, self.smooth).unwrap_or_default();
        if laid == 0.0 {
            return height;
        }
        height + laid * measured.freedom(place) * eased(slope / STEEP)
    }

    /// Returns true if the cells of `level` are small enough to show each sample.
    pub fn shows_samples(&self, level: u32) -> bool {
        // Equal sizes may differ by rounding.
        self.measured.as_ref().is_some_and(|measured| self.cell(level) <= measured.step() * (1.0 + 1e-6))
    }
}

fn eased(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
