//! Grids of heights.

use burgeon_spatial::ReferenceFrame;
use glam::DVec2;

/// Grid of heights of a run's terrain.
#[derive(Clone)]
pub struct HeightMap {
    /// Number of heights from west to east.
    pub columns: usize,
    /// Number of heights from north to south.
    pub rows: usize,
    /// Spacing (m) of neighbouring heights, in both directions.
    pub step: f64,
    /// Outer south-west corner (m): each height is in the centre of a cell, half a step from its edges.
    pub corner: DVec2,
    /// Projection and origin of the run, if it has them.
    pub frame: Option<ReferenceFrame>,
    /// Heights (m), row by row from the north, each from the west; NaN if missing.
    pub heights: Vec<f64>,
}

impl HeightMap {
    /// Returns the outer south-west corner: in the projection if a file can name it, otherwise in metres of the run.
    pub(super) fn projected_corner(&self) -> DVec2 {
        let frame =
            self.frame.as_ref().filter(|frame| frame.epsg.is_some() || frame.well_known_text().is_some());
        self.corner + frame.map_or(DVec2::ZERO, |frame| frame.origin.into())
    }

    /// Returns the EPSG code of the projection.
    #[cfg(feature = "data")]
    pub(super) fn epsg(&self) -> Option<u16> {
        self.frame.as_ref().and_then(|frame| frame.epsg)
    }
}

/// Converts a height to the precision of most formats.
pub(super) fn narrow(height: f64) -> f32 {
    height as f32
}
