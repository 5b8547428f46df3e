//! Measured ground: heights between samples, to which rules add detail that vanishes at the samples.

use glam::DVec2;

use super::world::World;

/// Heights (m) that were measured, or come from elsewhere.
pub trait HeightSource: Send + Sync {
    /// The height (m) at a place (m) and how steep (m/m) the ground is there; `None` far outside. Exactly the measured
    /// height at each sample; in between smoothly, or straight from one to the next.
    fn ground(&self, place: DVec2, smooth: bool) -> Option<(f64, f64)>;

    /// How much (0 to 1) detail may add at a place (m): nothing where it was measured.
    fn freedom(&self, place: DVec2) -> f64;

    /// The distance (m) of neighbouring samples, in the direction where they are closer.
    fn step(&self) -> f64;

    /// The places (m) of the samples in a box (m), row by row.
    fn samples(&self, low: DVec2, high: DVec2) -> Vec<DVec2>;
}

/// The slope (m/m) from which on detail is added in full to measured heights.
const STEEP: f64 = 0.3;

impl World {
    /// The height (m) of the ground at `place` (m), where the surface of the rules alone is `laid` (m) high: that, or
    /// what was measured and as much of it as may be added there.
    pub(super) fn ground(&self, place: DVec2, laid: f64) -> f64 {
        let Some(measured) = &self.measured else { return laid };
        let (height, slope) = measured.ground(place, self.smooth).unwrap_or_default();
        if laid == 0.0 {
            return height;
        }
        height + laid * measured.freedom(place) * eased(slope / STEEP)
    }

    /// Whether the cells of `level` are small enough to show each sample of what was measured.
    pub fn shows_samples(&self, level: u32) -> bool {
        // Sizes that are meant to be the same may differ by rounding.
        self.measured.as_ref().is_some_and(|measured| self.cell(level) <= measured.step() * (1.0 + 1e-6))
    }
}

fn eased(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
