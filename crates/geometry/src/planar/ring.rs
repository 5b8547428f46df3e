//! Rings of points.

use std::ops::{Add, Deref};

use geo::{ConvexHull, LineString};
use glam::{DVec2, DVec3};

use super::Line;
use super::measure::{bounds, contains, coord, edges, twice_area};
use super::point::{Point, check, point_text};
use burgeon_base::error::{Error, Result};

/// An open ring of points: the last point is joined to the first, but does not repeat it.
///
/// A ring has at least three finite points, each different from the previous one, and the last differs from
/// the first. It may have either direction. Points with heights may form any ring in space, such as the
/// outline of a wall.
///
/// ```
/// use burgeon_geometry::Ring;
/// use glam::DVec2;
///
/// let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)].map(DVec2::from);
/// let ring = Ring::new(points.to_vec())?;
/// assert_eq!((ring.area(), ring.length()), (6.0, 12.0));
/// assert_eq!(ring.clone().reversed().area(), -6.0);
/// assert!(ring.contains(DVec2::new(3.0, 1.0)) && !ring.contains(DVec2::new(1.0, 2.0)));
///
/// let closed = [points.as_slice(), &points[..1]].concat();
/// let error = Ring::new(closed).expect_err("a ring is open");
/// assert_eq!(error.message(), "the last point of the ring, 4, repeats point 1, (0, 0)");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Ring<P = DVec2> {
    points: Vec<P>,
}

impl<P: Point> Ring<P> {
    /// Creates a ring of `points`; fails with the number of the point that violates a condition.
    pub fn new(points: Vec<P>) -> Result<Self> {
        Self::with_name("the ring", points)
    }

    /// Creates a ring like [`Ring::new`], with a name for errors.
    pub(super) fn with_name(name: &str, points: Vec<P>) -> Result<Self> {
        check(name, &points)?;
        if let ([first, .., last], count) = (points.as_slice(), points.len())
            && first == last
        {
            let place = point_text(*first);
            let message = format!("the last point of {name}, {count}, repeats point 1, {place}");
            return Err(Error::geometry(message).help("remove it: a ring closes automatically"));
        }
        if points.len() < 3 {
            let count = points.len();
            return Err(Error::geometry(format!("{name} has too few points: {count}"))
                .help("give at least 3 points that differ"));
        }
        Ok(Self { points })
    }

    /// Creates a ring of `points` without repeated points; `None` if fewer than three remain or a point is
    /// not finite.
    pub fn without_repeats(mut points: Vec<P>) -> Option<Self> {
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        Self::new(points).ok()
    }

    /// Returns the points.
    pub fn into_points(self) -> Vec<P> {
        self.points
    }

    /// Returns the edges, each as its two ends, in the order of their first points.
    pub fn edges(&self) -> impl Iterator<Item = [P; 2]> + Clone + '_ {
        edges(&self.points)
    }

    /// Returns the horizontal area (m²); negative if the ring is clockwise.
    pub fn area(&self) -> f64 {
        self.twice_area() / 2.0
    }

    pub(super) fn twice_area(&self) -> f64 {
        twice_area(self.points.iter().copied())
    }

    /// Returns true if the ring is counter-clockwise as seen from above.
    pub fn is_counter_clockwise(&self) -> bool {
        self.twice_area() > 0.0
    }

    /// Returns the horizontal length (m) of the edges.
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.map(Point::flat)).map(|[a, b]| a.distance(b)).sum()
    }

    /// Returns the minimum and maximum coordinates (m).
    pub fn bounds(&self) -> [DVec2; 2] {
        bounds(self.points.iter().map(|point| point.flat())).unwrap_or_default()
    }

    /// Returns true if `place` is inside as seen from above, in either direction; on the border the result
    /// may be either.
    pub fn contains(&self, place: DVec2) -> bool {
        contains(&self.points, place)
    }

    /// Returns the horizontal convex hull of the points; `None` if they are collinear.
    pub fn hull(&self) -> Option<Ring> {
        hull(self.points.iter().copied())
    }

    /// Reverses the ring; the last point becomes the first.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self
    }

    /// Reverses the ring; the first point stays first.
    ///
    /// ```
    /// use burgeon_geometry::Ring;
    /// use glam::DVec2;
    ///
    /// let ring = Ring::new([(0.0, 0.0), (0.0, 2.0), (3.0, 0.0)].map(DVec2::from).to_vec())?;
    /// assert_eq!(ring.area(), -3.0);
    /// let turned = ring.turned();
    /// assert_eq!((turned.area(), turned[0], turned[1]), (3.0, DVec2::ZERO, DVec2::new(3.0, 0.0)));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    #[must_use]
    pub fn turned(mut self) -> Self {
        self.points[1..].reverse();
        self
    }

    /// Returns the closed line around the ring, which ends with its first point.
    pub fn around(&self) -> Line<P> {
        let closed = self.points.iter().chain(self.points.first()).copied().collect();
        // The invariants of a ring include those of a line.
        Line::from_valid(closed)
    }
}

impl<P: Point + Add<Output = P>> Ring<P> {
    /// Moves the ring by `offset` (m), which must be small enough that distinct points stay distinct after
    /// rounding.
    #[must_use]
    pub fn moved(mut self, offset: P) -> Self {
        self.points.iter_mut().for_each(|point| *point = *point + offset);
        self
    }
}

impl Ring {
    /// Returns the ring with a finite height (m) for each point.
    pub fn raised(&self, height: impl Fn(DVec2) -> f64) -> Ring<DVec3> {
        Ring { points: self.points.iter().map(|&point| point.extend(height(point))).collect() }
    }

    /// Returns the ring at a height (m).
    pub fn at_height(&self, height: f64) -> Ring<DVec3> {
        self.raised(|_| height)
    }
}

impl Ring<DVec3> {
    /// Projects a ring whose consecutive points differ horizontally onto the horizontal plane.
    pub(super) fn flattened(&self) -> Ring {
        Ring { points: self.points.iter().map(|point| point.truncate()).collect() }
    }
}

impl<P> AsRef<[P]> for Ring<P> {
    fn as_ref(&self) -> &[P] {
        &self.points
    }
}

impl<P> Deref for Ring<P> {
    type Target = [P];

    fn deref(&self) -> &[P] {
        &self.points
    }
}

impl<'a, P> IntoIterator for &'a Ring<P> {
    type Item = &'a P;
    type IntoIter = std::slice::Iter<'a, P>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.iter()
    }
}

/// Returns the convex hull of `points`, counter-clockwise from its westernmost corner; `None` if the points
/// are collinear.
///
/// Method: quickhull (C. Barber and others, "The quickhull algorithm for convex hulls", 1996), through `geo`.
///
/// ```
/// use burgeon_geometry::{Ring, hull};
/// use glam::DVec2;
///
/// let angle = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
/// let hull = hull(angle).expect("an area");
/// assert_eq!((hull.len(), hull.area()), (5, 3.5));
/// assert_eq!(hull[0], DVec2::ZERO);
/// ```
pub fn hull(points: impl IntoIterator<Item = impl Point>) -> Option<Ring> {
    let points: LineString = points.into_iter().map(|point| coord(point.flat())).collect();
    let found = points.convex_hull();
    let mut hull: Vec<DVec2> = found.exterior().0.iter().map(|at| DVec2::new(at.x, at.y)).collect();
    hull.pop();
    // Measurements of the hull must not depend on the order of the points.
    let west = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    let first = (0..hull.len()).min_by(|&a, &b| west(&hull[a], &hull[b])).unwrap_or(0);
    hull.rotate_left(first);
    Ring::new(hull).ok()
}
