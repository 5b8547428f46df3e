//! Points of cross-sections.

use glam::DVec2;

/// A point of a cross-section's outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPoint {
    /// Position (m).
    pub at: DVec2,
    /// Smooth shading at this point; otherwise the surface has a sharp edge.
    pub smooth: bool,
}

impl SectionPoint {
    /// Creates a point with a sharp edge.
    pub fn sharp(at: DVec2) -> Self {
        Self { at, smooth: false }
    }

    /// Creates a point of a smooth outline.
    pub fn smooth(at: DVec2) -> Self {
        Self { at, smooth: true }
    }
}

/// A corner of a section, or a point inserted into one of its edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    pub(crate) at: DVec2,
    pub(crate) smooth: bool,
    pub(crate) inserted: bool,
}
