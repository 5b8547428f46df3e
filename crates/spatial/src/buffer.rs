//! Buffers of geometries.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::overlay::{BufferSource, BufferStyle, Cap, Join, buffer};

use super::Geometry;
use super::edges::with_heights;
use super::overlay::{LEAST_EXTENT, Operand, area_of, geometry_of};
use super::plane::Plane;

/// Style of a buffer's border at corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BufferJoin {
    /// A circular arc.
    #[default]
    Round,
    /// A mitre, cut off at five times the distance.
    Mitre,
    /// A straight cut.
    Bevel,
}

/// Style of a buffer's border at the ends of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BufferCap {
    /// A semicircle.
    #[default]
    Round,
    /// A straight line through the end.
    Flat,
    /// A straight line beyond the end by the distance.
    Square,
}

/// Style of a buffer's border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferOptions {
    /// Style at corners.
    pub join: BufferJoin,
    /// Style at the ends of lines.
    pub cap: BufferCap,
    /// Number of edges per quarter circle, 1 to 1000.
    pub quadrant_segments: u32,
}

impl Default for BufferOptions {
    fn default() -> Self {
        Self { join: BufferJoin::Round, cap: BufferCap::Round, quadrant_segments: 8 }
    }
}

/// Mitre limit, as a multiple of the distance.
const MITRE_LIMIT: f64 = 5.0;

impl Geometry {
    /// Computes the area within `distance` (m) of the geometry; a negative distance shrinks areas.
    ///
    /// Empty if no area remains. Fails if the distance is not finite, if the number of segments is invalid,
    /// or if the result extends beyond [`FARTHEST`](super::FARTHEST).
    ///
    /// Arcs are equal to those of GEOS, up to rounding.
    ///
    /// ```
    /// use burgeon_spatial::{BufferCap, BufferJoin, BufferOptions, Geometry};
    ///
    /// let path = Geometry::from_wkt("LINESTRING (0 0, 10 0, 10 10)")?;
    /// let options = BufferOptions { join: BufferJoin::Mitre, cap: BufferCap::Flat, ..BufferOptions::default() };
    /// assert!((path.buffer(1.0, &options)?.area() - 40.0).abs() < 1e-6);
    /// let disc = Geometry::from_wkt("POINT (0 0)")?.buffer(2.0, &BufferOptions::default())?;
    /// assert!((disc.area() - 12.48).abs() < 0.01);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn buffer(&self, distance: f64, options: &BufferOptions) -> Result<Self> {
        if !distance.is_finite() || distance.abs() > super::FARTHEST {
            let taken = if distance.is_finite() { "a distance of at most 1e9" } else { "a finite distance" };
            return Err(Error::argument(format!("buffer takes {taken}, not {distance:?}"))
                .help("use metres: above 0 to grow, below 0 to shrink"));
        }
        if !(1..=1000).contains(&options.quadrant_segments) {
            let given = options.quadrant_segments;
            return Err(Error::argument(format!(
                "quadrant_segments of buffer must be from 1 to 1000, not {given}"
            ))
            .help("with 8, the area differs by 1 % from a circle"));
        }
        let made = self.grown(distance, options);
        made.check().map_err(|error| error.about("buffer")).map(|()| made)
    }

    fn grown(&self, distance: f64, options: &BufferOptions) -> Self {
        let Operand { areas, lines, points, .. } = Operand::new(Plane::absolute(), self);
        let areas = area_of(&areas);
        if distance.abs() < LEAST_EXTENT {
            return with_heights(geometry_of(&areas), &[self]);
        }
        let style = BufferStyle {
            join: match options.join {
                BufferJoin::Round => Join::Round,
                BufferJoin::Mitre => Join::Mitre(MITRE_LIMIT),
                BufferJoin::Bevel => Join::Bevel,
            },
            cap: match options.cap {
                BufferCap::Round => Cap::Round,
                BufferCap::Flat => Cap::Flat,
                BufferCap::Square => Cap::Square,
            },
            quadrant_segments: options.quadrant_segments,
        };
        let source = BufferSource { areas: &areas, lines: &lines, points: &points };
        // If the work of this thread is cancelled, the result is empty and not used.
        let made = buffer(source, distance, style).unwrap_or_default();
        with_heights(geometry_of(&made), &[self])
    }
}
