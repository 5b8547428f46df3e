//! Options and results of sweeps.

use glam::Vec3;

/// Texture length between two stations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lengthwise {
    /// Mean length of the surface: the texture keeps its scale even if the section tapers or twists.
    #[default]
    Surface,
    /// Length of the centreline: the texture follows the path, such as the storeys of a tower.
    Axis,
}

/// Shading, caps and texture of a sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepOptions {
    /// Smooth shading around the section, at points that are marked smooth.
    pub around: bool,
    /// Smooth shading along the path, at stations that are not marked sharp.
    pub along: bool,
    /// Closes the start with a cap.
    pub start_cap: bool,
    /// Closes the end with a cap.
    pub end_cap: bool,
    /// Joins the last station to the first, as in a ring without caps.
    pub closed: bool,
    /// Adds the back side of an open section; without it, the material must be two-sided.
    pub back: bool,
    /// Texture coordinate v (m) at the first station.
    pub v: f64,
    /// Length of v between two stations.
    pub lengthwise: Lengthwise,
}

impl Default for SweepOptions {
    /// Returns options for smooth shading where marked, with caps at both ends.
    fn default() -> Self {
        Self {
            around: true,
            along: true,
            start_cap: true,
            end_cap: true,
            closed: false,
            back: true,
            v: 0.0,
            lengthwise: Lengthwise::Surface,
        }
    }
}

/// Result of a sweep.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SweepResult {
    /// Texture coordinate v (m) at the end, where the next sweep can continue.
    pub v: f64,
    /// Open edges (m): at ends without a cap, and all around a ribbon.
    pub open: Vec<[Vec3; 2]>,
    /// Triangles by station, in order: the index of a station, and the number of triangles of the part after
    /// those that lead to the station and its cap.
    pub reached: Vec<(usize, usize)>,
}
