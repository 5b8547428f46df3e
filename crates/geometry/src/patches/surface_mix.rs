//! Interpolation between two surfaces.

use glam::DVec3;

use super::surface::{SplineSurface, SurfaceGrid, SurfaceKind};
use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};

/// Number of patches of a mixture of different surfaces for each of their patches, at least and at most.
const PATCHES: (usize, usize, usize) = (4, 8, 64);

impl SplineSurface {
    /// Returns the surface between this one (`t` = 0) and `other` (`t` = 1).
    ///
    /// If points, degree and knots correspond, points and weights are interpolated. Other surfaces are resampled, as
    /// Bezier patches through points at the same u and v.
    ///
    /// ```
    /// use burgeon_geometry::{SplineSurface, SurfaceGrid, SurfaceKind};
    /// use glam::DVec3;
    ///
    /// let flat = |z: f64| {
    ///     let row = |y: f64| vec![DVec3::new(0.0, y, z), DVec3::new(1.0, y, z)];
    ///     let grid = SurfaceGrid { points: vec![row(0.0), row(1.0)], ..SurfaceGrid::default() };
    ///     SplineSurface::new(SurfaceKind::BSpline, grid)
    /// };
    /// assert_eq!(flat(0.0)?.mix(&flat(4.0)?, 0.25)?.point(0.5, 0.5), DVec3::new(0.5, 0.5, 1.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn mix(&self, other: &Self, t: f64) -> Result<Self> {
        let blend = |(a, b): (DVec3, DVec3)| a * (1.0 - t) + b * t;
        if self.sizes == other.sizes && self.bases == other.bases {
            let points = self.points.iter().copied().zip(other.points.iter().copied()).map(blend).collect();
            let weight = |surface: &Self, index: usize| surface.weights.get(index).copied().unwrap_or(1.0);
            let rational = !self.weights.is_empty() || !other.weights.is_empty();
            // Beyond 0 and 1 a weight could become negative.
            let weights = (0..if rational { self.points.len() } else { 0 })
                .map(|index| (weight(self, index) * (1.0 - t) + weight(other, index) * t).max(1e-9));
            let weights = weights.collect();
            return Ok(Self { sizes: self.sizes, points, weights, bases: self.bases.clone() });
        }
        let counts = [0, 1].map(|direction| {
            let patches = |surface: &Self| surface.bases[direction].breaks().len() - 1;
            (PATCHES.0 * patches(self).max(patches(other))).clamp(PATCHES.1, PATCHES.2)
        });
        MemoryOwner::ensure_room((3 * counts[0] + 1) * (3 * counts[1] + 1) * size_of::<[DVec3; 2]>())?;
        let mut rows = Vec::with_capacity(counts[1] + 1);
        for row in 0..=counts[1] {
            Stop::check_current()?;
            let v = row as f64 / counts[1] as f64;
            let samples: Vec<DVec3> = (0..=counts[0])
                .map(|column| {
                    let u = column as f64 / counts[0] as f64;
                    blend((self.point(u, v), other.point(u, v)))
                })
                .collect();
            rows.push(controls(&samples));
        }
        let width = rows[0].len();
        let columns: Vec<Vec<DVec3>> = (0..width)
            .map(|column| controls(&rows.iter().map(|row| row[column]).collect::<Vec<_>>()))
            .collect();
        let points =
            (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        Self::new(SurfaceKind::Bezier, SurfaceGrid { points, ..SurfaceGrid::default() })
    }
}

/// Returns the Bezier points of the smooth uniform curve through at least 3 `samples`: cubic Catmull-Rom pieces, with
/// parabolas at the ends.
fn controls(samples: &[DVec3]) -> Vec<DVec3> {
    let last = samples.len() - 1;
    let tangent = |i: usize| match i {
        0 => samples[1] * 2.0 - samples[0] * 1.5 - samples[2] * 0.5,
        _ if i == last => samples[last] * 1.5 - samples[last - 1] * 2.0 + samples[last - 2] * 0.5,
        _ => (samples[i + 1] - samples[i - 1]) / 2.0,
    };
    let mut points = vec![samples[0]];
    for i in 0..last {
        points.extend([samples[i] + tangent(i) / 3.0, samples[i + 1] - tangent(i + 1) / 3.0, samples[i + 1]]);
    }
    points
}
