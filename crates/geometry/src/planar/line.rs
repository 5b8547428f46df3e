//! Polylines.

use std::ops::Deref;

use glam::DVec2;

use super::measure::bounds;
use super::point::{Point, check};
use burgeon_base::error::{Error, Result};

/// A polyline: at least two finite points, each different from the previous one.
///
/// ```
/// use burgeon_geometry::Line;
/// use glam::DVec2;
///
/// let line = Line::new(vec![DVec2::ZERO, DVec2::new(3.0, 0.0), DVec2::new(3.0, 4.0)])?;
/// assert_eq!((line.length(), line.edges().count()), (7.0, 2));
/// let error = Line::new(vec![DVec2::X, DVec2::X]).expect_err("a point is no line");
/// assert_eq!(error.message(), "point 2 of the line repeats point 1, (1, 0)");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Line<P = DVec2> {
    points: Vec<P>,
}

impl<P: Point> Line<P> {
    /// Creates a line through `points`; fails with the number of the point that violates a condition.
    pub fn new(points: Vec<P>) -> Result<Self> {
        check("the line", &points)?;
        if points.len() < 2 {
            let count = points.len();
            return Err(Error::geometry(format!("the line has too few points: {count}"))
                .help("give at least 2 distinct points"));
        }
        Ok(Self { points })
    }

    /// Creates a line through `points` without repeated points; `None` if fewer than two remain or a point is
    /// not finite.
    pub fn without_repeats(mut points: Vec<P>) -> Option<Self> {
        points.dedup();
        Self::new(points).ok()
    }

    /// Creates a line through points that are known to be valid.
    pub(super) fn from_valid(points: Vec<P>) -> Self {
        Self { points }
    }

    /// Returns the points.
    pub fn into_points(self) -> Vec<P> {
        self.points
    }

    /// Returns the edges, each as its two ends.
    pub fn edges(&self) -> impl Iterator<Item = [P; 2]> + '_ {
        self.points.windows(2).map(|pair| [pair[0], pair[1]])
    }

    /// Returns the horizontal length (m).
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.map(Point::flat)).map(|[a, b]| a.distance(b)).sum()
    }

    /// Returns the minimum and maximum coordinates (m).
    pub fn bounds(&self) -> [DVec2; 2] {
        bounds(self.points.iter().map(|point| point.flat())).unwrap_or_default()
    }

    /// Reverses the line.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self
    }
}

impl<P> Deref for Line<P> {
    type Target = [P];

    fn deref(&self) -> &[P] {
        &self.points
    }
}
