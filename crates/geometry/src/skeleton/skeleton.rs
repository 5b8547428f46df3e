//! Straight skeletons of polygons, and the motion of edges.

use glam::DVec2;

/// A point where faces meet: its horizontal position, and the time when the wavefront reached it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Horizontal position (m).
    pub at: DVec2,
    /// Distance that an edge of speed 1 has moved (m).
    pub time: f64,
}

/// Motion of an edge inwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Distance (m) that the edge moves while an edge of speed 1 moves 1 m.
    pub speed: f64,
    /// Initial rest (m), as the distance that an edge of speed 1 moves meanwhile.
    pub rest: f64,
}

impl Default for Pace {
    /// Returns the pace of an edge that moves from the start, at speed 1.
    fn default() -> Self {
        Self { speed: 1.0, rest: 0.0 }
    }
}

impl Pace {
    /// Pace of an edge that never moves, as below a gable; its face has no horizontal area.
    pub const STILL: Self = Self { speed: 0.0, rest: 0.0 };

    /// Returns the distance (m) that the edge has moved at `time` (m).
    ///
    /// ```
    /// use burgeon_geometry::skeleton::Pace;
    ///
    /// let slow_and_late = Pace { speed: 0.5, rest: 2.0 };
    /// assert_eq!([1.0, 2.0, 6.0].map(|time| slow_and_late.way(time)), [0.0, 0.0, 2.0]);
    /// assert!(slow_and_late.moves_at(3.0) && !slow_and_late.moves());
    /// ```
    pub fn way(&self, time: f64) -> f64 {
        self.speed * (time - self.rest).max(0.0)
    }

    /// Returns true if the edge moves from the start.
    pub fn moves(&self) -> bool {
        self.speed > 0.0 && self.rest <= 0.0
    }

    /// Returns true if the edge moves at `time` (m).
    pub fn moves_at(&self, time: f64) -> bool {
        self.speed > 0.0 && self.rest <= time
    }
}

/// Faces over a polygon, one for each edge, in the order of the edges.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// Corners of all faces, beginning with the corners of the polygon, in their order.
    pub peaks: Vec<Peak>,
    /// Faces as indices of `peaks`, counter-clockwise; each begins with the edge itself.
    pub faces: Vec<Vec<usize>>,
    /// Actual motion of the edges: as requested, except for edges that had to start because no other edge
    /// would have swept an area between them.
    pub paces: Vec<Pace>,
}

impl Skeleton {
    /// Returns the maximum time (m): the height of the highest ridge at a slope of 1.
    pub fn duration(&self) -> f64 {
        self.peaks.iter().map(|peak| peak.time).fold(0.0, f64::max)
    }
}
